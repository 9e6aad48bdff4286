/* Assertions: what has to hold inside of the library as long as the host keeps its promises. Built with PBMPM_ASSERTS=ON they are looked at, else they cost nothing. */
#ifndef PBMPM_SRC_BASE_ASSERTION_H
#define PBMPM_SRC_BASE_ASSERTION_H

#include <stdint.h>

#include "pbmpm/base.h"

#ifdef PBMPM_ASSERTS
enum { ASSERTS = 1 };
#else
enum { ASSERTS = 0 };
#endif

#define ASSERT(condition) (!ASSERTS || (condition) ? (void)0 : assertion_failed(#condition, __FILE__, __LINE__))

/* Asks the host's callback what is to be done; ends the process if it says so, or if there is none. */
void assertion_failed(const char *condition, const char *file, int32_t line);
void assertion_set_callback(pbmpm_assert_callback *callback, void *user);

#endif
