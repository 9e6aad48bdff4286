# pbmpm_compile_kernels(FILE OBJECTS [INCLUDE FOLDER...] [DEPENDS FILE...])
#
# Compiles an .ispc file for every instruction set and appends the objects to the list OBJECTS. An exported function f is in
# them as f_sse4, f_avx2 and f_avx512skx; on ARM and for WebAssembly, which have one set, as f. For several sets ISPC also writes an object with a dispatcher of its own, which
# is left out: src/ chooses by its own table. Under a sanitizer with Clang 19 or newer the kernels are instrumented too.
include_guard(GLOBAL)

if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(aarch64|arm64|ARM64)$")
    set(architecture aarch64)
    set(PBMPM_KERNEL_ISAS neon CACHE INTERNAL "")
    set(PBMPM_KERNEL_TARGETS neon-i32x4 CACHE INTERNAL "")
    set(PBMPM_KERNEL_MACHINES generic CACHE INTERNAL "")
elseif(CMAKE_SYSTEM_PROCESSOR STREQUAL wasm32)
    set(architecture arm) # whose structures are laid out as WebAssembly's
    set(PBMPM_KERNEL_ISAS wasm CACHE INTERNAL "")
    set(PBMPM_KERNEL_TARGETS generic-i32x4 CACHE INTERNAL "")
    set(PBMPM_KERNEL_MACHINES generic CACHE INTERNAL "")
else()
    set(architecture x86-64)
    set(PBMPM_KERNEL_ISAS sse4 avx2 avx512skx CACHE INTERNAL "")
    set(PBMPM_KERNEL_TARGETS sse4-i32x4,avx2-i32x8,avx512skx-x8 CACHE INTERNAL "")
    set(PBMPM_KERNEL_MACHINES nehalem haswell skylake-avx512 CACHE INTERNAL "") # what Clang calls them
endif()
set(PBMPM_KERNEL_ARCHITECTURE --arch=${architecture} CACHE INTERNAL "")

# The system's name in LLVM, where ISPC may not know it (Debian's knows Linux alone): LLVM's own compiler then makes the objects.
set(triple "")
set(features --relocation-model=pic)
if(CMAKE_CROSSCOMPILING AND WIN32)
    set(triple x86_64-w64-windows-gnu)
elseif(CMAKE_CROSSCOMPILING AND APPLE)
    string(REPLACE aarch64 arm64 triple "${architecture}-apple-macosx${CMAKE_OSX_DEPLOYMENT_TARGET}")
    string(REPLACE x86-64 x86_64 triple "${triple}")
endif()
if(CMAKE_SYSTEM_PROCESSOR STREQUAL wasm32)
    set(triple wasm32-unknown-wasi)
    set(features --relocation-model=static -mattr=+simd128,+bulk-memory,+nontrapping-fptoint,+sign-ext)
endif()
set(PBMPM_KERNEL_TRIPLE "${triple}" CACHE INTERNAL "")
set(PBMPM_KERNEL_FEATURES ${features} CACHE INTERNAL "")

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
    elseif(PBMPM_KERNEL_TRIPLE)
        set(suffix .ll)
        set(flags -O3 --emit-llvm-text)
    else()
        set(suffix .o)
        set(flags -O3 $<$<CONFIG:Debug,RelWithDebInfo>:-g> $<$<BOOL:${PBMPM_WARNINGS_AS_ERRORS}>:--werror>)
    endif()
    kernel_parts("${stem}" parts)
    list(TRANSFORM parts APPEND "${suffix}" OUTPUT_VARIABLE outputs)
    set(dispatcher "${stem}${suffix}")
    list(REMOVE_ITEM dispatcher ${outputs})
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
        BYPRODUCTS ${dispatcher}
        COMMAND "${CMAKE_ISPC_COMPILER}" "${file}" ${includes} ${definitions} ${PBMPM_KERNEL_ARCHITECTURE} --target=${PBMPM_KERNEL_TARGETS} --pic --wno-perf "${flags}" "${PBMPM_STRICT_FLAGS}"
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

# kernel_parts(STEM PARTS): what ISPC calls the object of each instruction set, less the suffix.
function(kernel_parts stem parts)
    list(LENGTH PBMPM_KERNEL_ISAS count)
    set(${parts} "${stem}" PARENT_SCOPE)
    if(count GREATER 1)
        list(TRANSFORM PBMPM_KERNEL_ISAS REPLACE "(.+)" "${stem}_\\1" OUTPUT_VARIABLE named)
        set(${parts} ${named} PARENT_SCOPE)
    endif()
endfunction()

# translate_kernels(STEM OBJECTS): ISPC has written LLVM's text for Linux. What it says of the system is left out, functions are marked as hidden, and LLVM's
# llc makes the objects. It fuses operations as ISPC itself does: so results are those of Linux, bit for bit.
function(translate_kernels stem objects)
    find_program(PBMPM_LLC NAMES llc-19 llc-20 llc REQUIRED DOC "Compiles kernels for systems that ISPC does not know (Debian: llvm)")
    kernel_parts("${stem}" parts)
    set(made "")
    foreach(part machine IN ZIP_LISTS parts PBMPM_KERNEL_MACHINES)
        add_custom_command(
            OUTPUT "${part}.o"
            COMMAND sed -e "/^target /d" -e "/^define internal/!s/^define /define hidden /"
                -e "/^attributes #.* nounwind/s/{/{ uwtable/" "${part}.ll" > "${part}.translated.ll"
            COMMAND "${PBMPM_LLC}" -O2 -mtriple=${PBMPM_KERNEL_TRIPLE} -mcpu=${machine} ${PBMPM_KERNEL_FEATURES} --fp-contract=fast -filetype=obj
                "${part}.translated.ll" -o "${part}.o"
            DEPENDS "${part}.ll"
            COMMENT "Translating ${part} for ${PBMPM_KERNEL_TRIPLE}"
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
    kernel_parts("${stem}" parts)
    foreach(part machine IN ZIP_LISTS parts PBMPM_KERNEL_MACHINES)
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
