# pbmpm_find_ispc(): leaves the path of an ISPC compiler in the cache variable CMAKE_ISPC_COMPILER. In this order: what
# the user set, the one on the PATH, the one fetched before, one fetched now.
set(pbmpm_ispc_minimum 1.22)

function(pbmpm_ispc_is_usable result path)
    execute_process(COMMAND "${path}" --version OUTPUT_VARIABLE text ERROR_QUIET RESULT_VARIABLE status)
    string(REGEX MATCH "ISPC\\), ([0-9.]+)" text "${text}")
    if(NOT status EQUAL 0 OR "${CMAKE_MATCH_1}" VERSION_LESS ${pbmpm_ispc_minimum})
        set(${result} FALSE PARENT_SCOPE)
    endif()
endfunction()

function(pbmpm_find_ispc)
    set(fetched "${cache_dir}/ispc/bin/ispc")
    if(CMAKE_ISPC_COMPILER STREQUAL fetched AND NOT EXISTS "${fetched}")
        unset(CMAKE_ISPC_COMPILER CACHE) # somebody emptied the cache
    endif()
    if(CMAKE_ISPC_COMPILER)
        set(usable TRUE)
        pbmpm_ispc_is_usable(usable "${CMAKE_ISPC_COMPILER}")
        if(NOT usable)
            message(FATAL_ERROR "CMAKE_ISPC_COMPILER is ${CMAKE_ISPC_COMPILER}, which is no ISPC ${pbmpm_ispc_minimum} or newer. "
                "Give another path, or none: cmake -U CMAKE_ISPC_COMPILER ...")
        endif()
        return()
    endif()
    find_program(CMAKE_ISPC_COMPILER ispc VALIDATOR pbmpm_ispc_is_usable DOC "The ISPC compiler")
    if(NOT CMAKE_ISPC_COMPILER)
        if(NOT EXISTS "${fetched}")
            pbmpm_fetch_ispc()
        endif()
        set_property(CACHE CMAKE_ISPC_COMPILER PROPERTY VALUE "${fetched}")
    endif()
    message(STATUS "ISPC: ${CMAKE_ISPC_COMPILER}")
endfunction()

function(pbmpm_fetch_ispc)
    if(NOT PBMPM_PROVISION)
        message(FATAL_ERROR "There is no ISPC ${pbmpm_ispc_minimum} or newer on the PATH, and PBMPM_PROVISION is OFF. "
            "Install it and configure with -DCMAKE_ISPC_COMPILER=/path/to/ispc, or fetch it once with\n"
            "  sh ${CMAKE_CURRENT_SOURCE_DIR}/provision.sh ${cache_dir}")
    endif()
    execute_process(COMMAND sh "${CMAKE_CURRENT_SOURCE_DIR}/provision.sh" "${cache_dir}" RESULT_VARIABLE status)
    if(NOT status EQUAL 0)
        message(FATAL_ERROR "ISPC could not be fetched; see above. With one of your own, ${pbmpm_ispc_minimum} or newer, "
            "configure with -DCMAKE_ISPC_COMPILER=/path/to/ispc")
    endif()
endfunction()
