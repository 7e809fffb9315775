# Everything comes from Debian 12's packages; Utilities/Setup/packages.txt is the list.
find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
# Of its archive one hash is taken: the library is 21,000 relocations at each start.
set(OPENSSL_USE_STATIC_LIBS ON)
if(NOT OPENSSL_CRYPTO_LIBRARY MATCHES "\\.a$")
  unset(OPENSSL_CRYPTO_LIBRARY CACHE) # of a build folder that had the library
endif()
find_package(OpenSSL REQUIRED)
find_package(ZLIB REQUIRED)
find_package(PNG 1.6 REQUIRED)
find_package(JPEG REQUIRED)
find_package(embree 3.13 REQUIRED)
find_package(assimp 5.2 REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(OpenGL REQUIRED COMPONENTS OpenGL EGL)
set(dgtk_editor_vtk "")
if(DGTK_EDITOR)
  find_package(Qt5 5.15 REQUIRED COMPONENTS Widgets Test)
  set(dgtk_editor_vtk CommonExecutionModel FiltersSources GUISupportQt)
endif()
find_package(VTK 9.1 REQUIRED COMPONENTS CommonCore CommonDataModel CommonExecutionModel CommonMath CommonTransforms FiltersCore FiltersGeometry FiltersSources ImagingCore RenderingCore
  RenderingOpenGL2 glew WrappingPythonCore Python ${dgtk_editor_vtk})

# dgtk_find_library(<target> <header> <library>): libraries whose own CMake packages ask for programs we do not need.
function(dgtk_find_library target header library)
  find_path(${target}_INCLUDE_DIR ${header} REQUIRED)
  find_library(${target}_LIBRARY ${library} REQUIRED)
  add_library(DGTkThirdParty::${target} INTERFACE IMPORTED GLOBAL)
  target_include_directories(DGTkThirdParty::${target} SYSTEM INTERFACE "${${target}_INCLUDE_DIR}")
  target_link_libraries(DGTkThirdParty::${target} INTERFACE "${${target}_LIBRARY}")
endfunction()
dgtk_find_library(OpenImageIO OpenImageIO/imageio.h OpenImageIO)
dgtk_find_library(Deflate libdeflate.h deflate)

# OpenCV without its CMake package, which asks for every module.
find_path(OPENCV_INCLUDE_DIR opencv2/calib3d.hpp PATH_SUFFIXES opencv4 REQUIRED)
find_library(OPENCV_CORE_LIBRARY opencv_core REQUIRED)
find_library(OPENCV_CALIB3D_LIBRARY opencv_calib3d REQUIRED)
add_library(DGTkThirdParty::OpenCV INTERFACE IMPORTED GLOBAL)
target_include_directories(DGTkThirdParty::OpenCV SYSTEM INTERFACE "${OPENCV_INCLUDE_DIR}")
target_link_libraries(DGTkThirdParty::OpenCV INTERFACE "${OPENCV_CALIB3D_LIBRARY}" "${OPENCV_CORE_LIBRARY}")

# Bullet in double precision, whose CMake package gives no targets; FCL's asks for octomap, which is not needed.
find_path(BULLET_INCLUDE_DIR btBulletDynamicsCommon.h PATH_SUFFIXES bullet REQUIRED)
add_library(DGTkThirdParty::Bullet INTERFACE IMPORTED GLOBAL)
target_include_directories(DGTkThirdParty::Bullet SYSTEM INTERFACE "${BULLET_INCLUDE_DIR}")
target_compile_definitions(DGTkThirdParty::Bullet INTERFACE BT_USE_DOUBLE_PRECISION)
foreach(part BulletDynamics BulletCollision LinearMath)
  find_library(${part}_LIBRARY "${part}-float64" REQUIRED)
  target_link_libraries(DGTkThirdParty::Bullet INTERFACE "${${part}_LIBRARY}")
endforeach()
dgtk_find_library(FCL fcl/fcl.h fcl)
