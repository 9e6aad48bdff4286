# pbmpm_find_unity(): leaves the path of the sources of the Unity test framework in the cache variable UNITY_SOURCE_DIR.
# In this order: what the user set, where Debian and others put it, what was fetched before, what is fetched now.
function(pbmpm_find_unity)
    set(fetched "${cache_dir}/unity")
    if(UNITY_SOURCE_DIR STREQUAL fetched AND NOT EXISTS "${fetched}")
        unset(UNITY_SOURCE_DIR CACHE) # somebody emptied the cache
    endif()
    if(UNITY_SOURCE_DIR AND NOT EXISTS "${UNITY_SOURCE_DIR}/src/unity.c")
        message(FATAL_ERROR "UNITY_SOURCE_DIR is ${UNITY_SOURCE_DIR}, which has no src/unity.c")
    endif()
    find_path(UNITY_SOURCE_DIR src/unity.c
        PATHS /usr/share/cmock/vendor/unity /usr/src/unity /usr/src/Unity "${fetched}"
        NO_DEFAULT_PATH DOC "The sources of the Unity test framework")
    if(UNITY_SOURCE_DIR)
        return()
    endif()
    if(NOT PBMPM_PROVISION)
        message(FATAL_ERROR "There is no Unity test framework here, and PBMPM_PROVISION is OFF. Configure with "
            "-DUNITY_SOURCE_DIR=/path/to/Unity or -DPBMPM_TESTS=OFF, or fetch it once with\n"
            "  sh ${CMAKE_CURRENT_SOURCE_DIR}/provision.sh ${cache_dir}")
    endif()
    execute_process(COMMAND sh "${CMAKE_CURRENT_SOURCE_DIR}/provision.sh" "${cache_dir}" RESULT_VARIABLE status)
    if(NOT status EQUAL 0)
        message(FATAL_ERROR "Unity could not be fetched; see above. With sources of your own configure with "
            "-DUNITY_SOURCE_DIR=/path/to/Unity, or leave the tests out: -DPBMPM_TESTS=OFF")
    endif()
    set_property(CACHE UNITY_SOURCE_DIR PROPERTY VALUE "${fetched}")
endfunction()
