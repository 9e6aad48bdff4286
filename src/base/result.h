/* Results and the thread-local message that goes with a failure. */
#ifndef PBMPM_SRC_BASE_RESULT_H
#define PBMPM_SRC_BASE_RESULT_H

#include "pbmpm/base.h"

/* Stores the message for pbmpm_last_error(), tells the log callback, and returns `result`. */
pbmpm_result fail(pbmpm_result result, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Stores a message without telling the log callback, which knows already or need not know, and returns `result`. */
pbmpm_result result_pass_on(pbmpm_result result, const char *text);

const char *result_message(void);
const char *result_name(pbmpm_result result);
void result_set_log(pbmpm_log_callback *callback, void *user);
/* Tells the log callback something that is no failure of a call. */
void result_log(pbmpm_log_level level, const char *format, ...) __attribute__((format(printf, 2, 3)));

#endif
