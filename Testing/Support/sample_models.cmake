# Says what a run without the sample models does not see.
if(DEFINED ENV{DGTK_EXTRA_MODELS})
  set(SAMPLES "$ENV{DGTK_EXTRA_MODELS}")
endif()
if(SAMPLES STREQUAL "")
  message("left out: comparisons with sample models, which are not part of the source (set DGTK_EXTRA_MODELS)")
elseif(NOT EXISTS "${SAMPLES}/TRUTH.json")
  message(FATAL_ERROR "${SAMPLES} has no TRUTH.json: DGTK_EXTRA_MODELS is not the folder of the sample models")
endif()
