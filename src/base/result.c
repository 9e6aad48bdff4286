#include "base/result.h"

#include <stdarg.h>
#include <stdio.h>

#include "base/cpu.h"

static _Thread_local char message[256];
static pbmpm_log_callback *log_callback;
static void *log_user;

static void tell(pbmpm_log_level level, const char *line)
{
    if (!log_callback) return;
    const uint32_t mode = float_mode_lend();
    log_callback(level, line, log_user);
    float_mode_take_back(mode);
}

pbmpm_result fail(pbmpm_result result, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    tell(PBMPM_LOG_ERROR, message);
    return result;
}

pbmpm_result result_pass_on(pbmpm_result result, const char *text)
{
    snprintf(message, sizeof message, "%s", text);
    return result;
}

void result_log(pbmpm_log_level level, const char *format, ...)
{
    if (!log_callback) return;
    char line[256];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    tell(level, line);
}

const char *result_message(void) { return message; }

void result_set_log(pbmpm_log_callback *callback, void *user)
{
    log_callback = callback;
    log_user = user;
}

const char *result_name(pbmpm_result result)
{
    switch (result) {
    case PBMPM_OK: return "PBMPM_OK";
    case PBMPM_ERROR_INVALID_ARGUMENT: return "PBMPM_ERROR_INVALID_ARGUMENT";
    case PBMPM_ERROR_INVALID_ID: return "PBMPM_ERROR_INVALID_ID";
    case PBMPM_ERROR_OUT_OF_MEMORY: return "PBMPM_ERROR_OUT_OF_MEMORY";
    case PBMPM_ERROR_CAPACITY: return "PBMPM_ERROR_CAPACITY";
    case PBMPM_ERROR_BUSY: return "PBMPM_ERROR_BUSY";
    case PBMPM_ERROR_UNSUPPORTED_CPU: return "PBMPM_ERROR_UNSUPPORTED_CPU";
    case PBMPM_ERROR_UNSUPPORTED: return "PBMPM_ERROR_UNSUPPORTED";
    case PBMPM_ERROR_THREAD: return "PBMPM_ERROR_THREAD";
    case PBMPM_ERROR_IN_USE: return "PBMPM_ERROR_IN_USE";
    case PBMPM_ERROR_FORKED: return "PBMPM_ERROR_FORKED";
    case PBMPM_ERROR_DAMAGED: return "PBMPM_ERROR_DAMAGED";
    case PBMPM_ERROR_FOREIGN: return "PBMPM_ERROR_FOREIGN";
    case PBMPM_RESULT_FORCE32: break;
    }
    return "unknown result";
}
