# Registration tables: one row a newcomer. `dgtk_reader(Ac3d EXTENSIONS ac acc FORMAT ac3d DESCRIPTION "AC3D")` declares
# that dgtkAc3dReader.cxx, in the module's folder or below, defines the factory of that name; the tables are generated, there are no static initialisers.
#
#   dgtk_registry_begin(<kind>)            kind: camera, exporter, reader, representation, layer, writer
#   dgtk_<kind>(<Name> KEY value... )
#   dgtk_registry_end(<kind> <output.cxx>) configures <kind>Registry.cxx.in in the module's folder; @DGTK_DECLARATIONS@ and
#                                          @DGTK_ROWS@ are replaced.

macro(dgtk_registry_begin kind)
  set(_dgtk_${kind}_declarations "")
  set(_dgtk_${kind}_rows "")
  set(_dgtk_${kind}_sources "")
endmacro()

function(_dgtk_quote_list out)
  set(text "")
  foreach(item IN LISTS ARGN)
    string(APPEND text "\"${item}\", ")
  endforeach()
  set(${out} "${text}" PARENT_SCOPE)
endfunction()

macro(dgtk_reader name)
  cmake_parse_arguments(_row "" "FORMAT;DESCRIPTION;THROUGH" "EXTENSIONS" ${ARGN})
  _dgtk_quote_list(_extensions ${_row_EXTENSIONS})
  set(_arguments "(const std::string& path, const ReadOptions& options)")
  if(_row_THROUGH)
    set(_read "[]${_arguments} { return readThrough${_row_THROUGH}(path, \"${_row_FORMAT}\", options); }")
  else()
    set(_read "&read${name}")
    string(APPEND _dgtk_reader_declarations "ModelContents read${name}${_arguments};\n")
    dgtk_find_source(_source "dgtk${name}Reader.cxx")
    list(APPEND _dgtk_reader_sources "${_source}")
  endif()
  string(APPEND _dgtk_reader_rows
    "  { { \"${name}\", \"${_row_FORMAT}\", \"${_row_DESCRIPTION}\", { ${_extensions}} }, ${_read} },\n")
endmacro()

macro(dgtk_representation name)
  cmake_parse_arguments(_row "USUAL" "LAYER;DESCRIPTION" "" ${ARGN})
  string(APPEND _dgtk_representation_declarations "std::unique_ptr<Representation> make${name}();\n")
  string(APPEND _dgtk_representation_rows
    "  { { \"${name}\", \"${_row_LAYER}\", \"${_row_DESCRIPTION}\", \"${_row_USUAL}\" == std::string(\"TRUE\") }, &make${name} },\n")
  dgtk_find_source(_source "dgtk${name}.cxx")
  list(APPEND _dgtk_representation_sources "${_source}")
endmacro()

macro(dgtk_writer name)
  cmake_parse_arguments(_row "" "FORMAT;EXTENSION;DESCRIPTION" "" ${ARGN})
  string(APPEND _dgtk_writer_declarations "extern const WriterEntry writer${name};\n")
  string(APPEND _dgtk_writer_rows
    "  { { \"${name}\", \"${_row_FORMAT}\", \"${_row_EXTENSION}\", \"${_row_DESCRIPTION}\" }, &writer${name} },\n")
  dgtk_find_source(_source "dgtk${name}Writer.cxx")
  list(APPEND _dgtk_writer_sources "${_source}")
endmacro()

macro(dgtk_camera name)
  cmake_parse_arguments(_row "" "MODEL;DESCRIPTION" "" ${ARGN})
  string(APPEND _dgtk_camera_declarations "extern const CameraEntry camera${name};\n")
  string(APPEND _dgtk_camera_rows "  { \"${_row_MODEL}\", \"${_row_DESCRIPTION}\", &camera${name} },\n")
  dgtk_find_source(_source "dgtk${name}Camera.cxx")
  list(APPEND _dgtk_camera_sources "${_source}")
endmacro()

macro(dgtk_layer name)
  string(SUBSTRING "${name}" 0 1 _first)
  string(TOLOWER "${_first}" _first)
  string(SUBSTRING "${name}" 1 -1 _rest)
  string(APPEND _dgtk_layer_declarations "LayerList ${_first}${_rest}Layers();\n")
  string(APPEND _dgtk_layer_rows "&${_first}${_rest}Layers, ")
  dgtk_find_source(_source "dgtk${name}Layer.cxx")
  list(APPEND _dgtk_layer_sources "${_source}")
endmacro()

macro(dgtk_exporter name)
  cmake_parse_arguments(_row "" "FORMAT;DESCRIPTION" "" ${ARGN})
  string(APPEND _dgtk_exporter_declarations "std::unique_ptr<Exporter> make${name}Exporter();\n")
  string(APPEND _dgtk_exporter_rows "  { { \"${_row_FORMAT}\", \"${_row_DESCRIPTION}\" }, &make${name}Exporter },\n")
  dgtk_find_source(_source "dgtk${name}Exporter.cxx")
  list(APPEND _dgtk_exporter_sources "${_source}")
endmacro()

macro(dgtk_registry_end kind template output)
  set(DGTK_DECLARATIONS "${_dgtk_${kind}_declarations}")
  set(DGTK_ROWS "${_dgtk_${kind}_rows}")
  configure_file("${CMAKE_CURRENT_SOURCE_DIR}/${template}" "${CMAKE_CURRENT_BINARY_DIR}/${output}" @ONLY)
endmacro()
