/* pbmpm: version of the library. The build system reads the numbers from here; nothing else states them. */
#ifndef PBMPM_VERSION_H
#define PBMPM_VERSION_H

#define PBMPM_VERSION_MAJOR 0
#define PBMPM_VERSION_MINOR 2
#define PBMPM_VERSION_PATCH 0

/** Number of the binary interface (the shared library's SOVERSION). It changes only when an existing
 *  function, constant or field changes its meaning, type or place. */
#define PBMPM_ABI_VERSION 1

#endif
