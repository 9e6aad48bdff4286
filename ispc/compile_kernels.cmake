# pbmpm_compile_kernels(FILE OBJECTS [INCLUDE FOLDER...] [DEPENDS FILE...])
#
# Compiles an .ispc file for every instruction set and appends the objects to the list OBJECTS. An exported function f is in
# them as f_sse4, f_avx2 and f_avx512skx. ISPC also writes an object with a dispatcher of its own, which is left out: src/
# chooses by its own table. Under a sanitizer with Clang 19 or newer the kernels are instrumented too.
include_guard(GLOBAL)

set(PBMPM_KERNEL_ISAS sse4 avx2 avx512skx CACHE INTERNAL "")
set(PBMPM_KERNEL_TARGETS sse4-i32x4,avx2-i32x8,avx512skx-x8 CACHE INTERNAL "")
set(PBMPM_KERNEL_MACHINES nehalem haswell skylake-avx512 CACHE INTERNAL "") # what Clang calls them

option(PBMPM_ONE_ISA "For tests that build often: SSE4 kernels stand in for all others" OFF)
mark_as_advanced(PBMPM_ONE_ISA)

set(instrument FALSE)
if(NOT PBMPM_SANITIZE STREQUAL none)
    if(CMAKE_C_COMPILER_ID STREQUAL "Clang" AND CMAKE_C_COMPILER_VERSION VERSION_GREATER_EQUAL 19)
        set(instrument TRUE)
    else()
        message(STATUS "No Clang 19 or newer: the sanitizer sees the C code but not inside the kernels")
    endif()
endif()
set(PBMPM_INSTRUMENT_KERNELS ${instrument} CACHE INTERNAL "")

function(pbmpm_compile_kernels file objects)
    cmake_parse_arguments(PARSE_ARGV 2 arg "" "" "INCLUDE;DEPENDS")
    cmake_path(ABSOLUTE_PATH file)
    cmake_path(GET file STEM name)
    set(stem "${CMAKE_CURRENT_BINARY_DIR}/${name}")
    if(PBMPM_INSTRUMENT_KERNELS)
        set(suffix .ll)
        set(flags -O1 -g --emit-llvm-text)
    elseif(WIN32 AND CMAKE_CROSSCOMPILING)
        set(suffix .ll)
        set(flags -O3 --emit-llvm-text)
    else()
        set(suffix .o)
        set(flags -O3 $<$<CONFIG:Debug,RelWithDebInfo>:-g> $<$<BOOL:${PBMPM_WARNINGS_AS_ERRORS}>:--werror>)
    endif()
    list(TRANSFORM PBMPM_KERNEL_ISAS REPLACE "(.+)" "${stem}_\\1${suffix}" OUTPUT_VARIABLE outputs)
    list(TRANSFORM arg_INCLUDE PREPEND "-I" OUTPUT_VARIABLE includes)
    set(definitions ${PBMPM_MATERIAL_DEFINITIONS} ${PBMPM_STRICT_DEFINITION})
    list(TRANSFORM definitions PREPEND "-D")
    if(PBMPM_ONE_ISA AND NOT PBMPM_INSTRUMENT_KERNELS)
        compile_one_isa("${file}" "${stem}" "${includes}" "${definitions}" "${arg_DEPENDS}" "${outputs}")
        set(${objects} ${${objects}} ${outputs} PARENT_SCOPE)
        return()
    endif()
    add_custom_command(
        OUTPUT ${outputs}
        BYPRODUCTS "${stem}${suffix}"
        COMMAND "${CMAKE_ISPC_COMPILER}" "${file}" ${includes} ${definitions} --target=${PBMPM_KERNEL_TARGETS} --pic --wno-perf "${flags}" "${PBMPM_STRICT_FLAGS}"
            -o "${stem}${suffix}"
        DEPENDS "${file}" ${arg_DEPENDS} "${CMAKE_ISPC_COMPILER}"
        COMMENT "Compiling ${name}.ispc for ${PBMPM_KERNEL_TARGETS}"
        COMMAND_EXPAND_LISTS VERBATIM)
    if(PBMPM_INSTRUMENT_KERNELS)
        instrument_kernels("${stem}" outputs)
    elseif(suffix STREQUAL .ll)
        translate_kernels("${stem}" outputs)
    endif()
    set(${objects} ${${objects}} ${outputs} PARENT_SCOPE)
endfunction()

# translate_kernels(STEM OBJECTS): an ISPC without Windows among its targets has written LLVM's text for Linux; what it says of the system is replaced, and
# LLVM's llc makes the objects. Fused operations as ISPC itself makes them: so results are those of Linux, bit for bit.
function(translate_kernels stem objects)
    find_program(PBMPM_LLC NAMES llc-19 llc-20 llc REQUIRED DOC "Compiles kernels for Windows (Debian: llvm)")
    set(layout "e-m:w-p270:32:32-p271:32:32-p272:64:64-i64:64-i128:128-f80:128-n8:16:32:64-S128") # LLVM's for x86-64 Windows
    set(made "")
    foreach(isa machine IN ZIP_LISTS PBMPM_KERNEL_ISAS PBMPM_KERNEL_MACHINES)
        set(part "${stem}_${isa}")
        add_custom_command(
            OUTPUT "${part}.o"
            COMMAND sed -e "s/^target datalayout = .*/target datalayout = \"${layout}\"/" -e "s/^target triple = .*/target triple = \"x86_64-w64-windows-gnu\"/"
                -e "/^attributes #.* nounwind/s/{/{ uwtable/" "${part}.ll" > "${part}.windows.ll"
            COMMAND "${PBMPM_LLC}" -O2 -mtriple=x86_64-w64-windows-gnu -mcpu=${machine} --relocation-model=pic --fp-contract=fast -filetype=obj
                "${part}.windows.ll" -o "${part}.o"
            DEPENDS "${part}.ll"
            COMMENT "Translating ${part} for Windows"
            VERBATIM)
        list(APPEND made "${part}.o")
    endforeach()
    set(${objects} ${made} PARENT_SCOPE)
endfunction()

# The same functions under the names of each instruction set.
function(compile_one_isa file stem includes definitions depends outputs)
    find_program(CMAKE_OBJCOPY objcopy REQUIRED)
    find_program(CMAKE_NM nm REQUIRED)
    list(GET PBMPM_KERNEL_TARGETS 0 target)
    string(REGEX REPLACE ",.*" "" target "${target}")
    set(renamings "")
    foreach(isa output IN ZIP_LISTS PBMPM_KERNEL_ISAS outputs)
        string(APPEND renamings "'${CMAKE_NM}' -g --defined-only '${stem}.o' | sed 's/.* //; s/.*/& &_${isa}/' > '${output}.names' && "
            "'${CMAKE_OBJCOPY}' --redefine-syms='${output}.names' '${stem}.o' '${output}' && ")
    endforeach()
    add_custom_command(
        OUTPUT ${outputs}
        BYPRODUCTS "${stem}.o"
        COMMAND "${CMAKE_ISPC_COMPILER}" "${file}" ${includes} ${definitions} --target=${target} --pic --wno-perf -O2 -o "${stem}.o"
        COMMAND sh -c "${renamings} true"
        DEPENDS "${file}" ${depends} "${CMAKE_ISPC_COMPILER}"
        COMMENT "Compiling ${file} for ${target} alone"
        VERBATIM)
endfunction()

# instrument_kernels(STEM OBJECTS): ISPC has written LLVM's text; its functions are marked, and Clang makes the objects.
function(instrument_kernels stem objects)
    set(made "")
    foreach(isa machine IN ZIP_LISTS PBMPM_KERNEL_ISAS PBMPM_KERNEL_MACHINES)
        set(part "${stem}_${isa}")
        add_custom_command(
            OUTPUT "${part}.o"
            COMMAND sed "/^attributes #.* nounwind/s/{/{ sanitize_${PBMPM_SANITIZE}/" "${part}.ll" > "${part}.marked.ll"
            COMMAND "${CMAKE_C_COMPILER}" -x ir -O1 -g -fPIC -march=${machine} -fsanitize=${PBMPM_SANITIZE}
                -Wno-override-module -c "${part}.marked.ll" -o "${part}.o"
            DEPENDS "${part}.ll"
            COMMENT "Instrumenting ${part}"
            VERBATIM)
        list(APPEND made "${part}.o")
    endforeach()
    set(${objects} ${made} PARENT_SCOPE)
endfunction()
