# Which materials are built: the option PBMPM_MATERIALS, and PBMPM_WITH_LIQUID=0|1 and so on made of it, for the kernels (see
# compile_kernels.cmake) and for C (carried by the target pbmpm_kernels). Nothing else says what is in.
include_guard(GLOBAL)

set(pbmpm_known_materials liquid elastic sand visco)
set(PBMPM_MATERIALS "${pbmpm_known_materials}" CACHE STRING
    "Materials to build, a list of liquid, elastic, sand and visco; using one that is left out is an error")

set(unknown ${PBMPM_MATERIALS})
list(REMOVE_ITEM unknown ${pbmpm_known_materials})
if(NOT unknown STREQUAL "" OR PBMPM_MATERIALS STREQUAL "")
    message(FATAL_ERROR "PBMPM_MATERIALS is '${PBMPM_MATERIALS}'; it is a list of at least one of: ${pbmpm_known_materials}")
endif()

set(definitions "")
set(built "")
set(left_out "")
foreach(material IN LISTS pbmpm_known_materials)
    string(TOUPPER "PBMPM_WITH_${material}" macro)
    if(material IN_LIST PBMPM_MATERIALS)
        list(APPEND definitions ${macro}=1)
        list(APPEND built ${material})
    else()
        list(APPEND definitions ${macro}=0)
        list(APPEND left_out ${material})
    endif()
endforeach()
set(PBMPM_MATERIAL_DEFINITIONS "${definitions}" CACHE INTERNAL "")
set(PBMPM_MATERIALS_BUILT "${built}" CACHE INTERNAL "")
set(PBMPM_MATERIALS_LEFT_OUT "${left_out}" CACHE INTERNAL "")
if(left_out)
    list(JOIN left_out ", " text)
    message(STATUS "Materials left out: ${text}")
endif()
