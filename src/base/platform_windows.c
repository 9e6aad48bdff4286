#include "base/platform.h"
#include "base/thread.h"

#include <malloc.h>
#include <windows.h>

long platform_core_count(void) { return (long)GetActiveProcessorCount(ALL_PROCESSOR_GROUPS); }

void *platform_allocate(size_t size, size_t alignment) { return _aligned_malloc(size, alignment); }

void platform_release(void *block) { _aligned_free(block); }

/* As Microsoft documents for DllMain: at the end of a process other threads are gone when libraries are told. */
bool platform_has_lost_its_threads(void)
{
    typedef BOOLEAN(NTAPI ShutdownInProgress)(void);
    const HMODULE ntdll = GetModuleHandleW(L"ntdll.dll");
    ShutdownInProgress *const ending = ntdll ? (ShutdownInProgress *)(void (*)(void))GetProcAddress(ntdll, "RtlDllShutdownInProgress") : NULL;
    return ending && ending();
}

/* The module with this code, counted once more. */
static HMODULE hold_own_code(void)
{
    HMODULE code;
    return GetModuleHandleExW(GET_MODULE_HANDLE_EX_FLAG_FROM_ADDRESS, (LPCWSTR)(const void *)hold_own_code, &code) ? code : NULL;
}

static void let_go_of_own_code(void)
{
    HMODULE code;
    if (GetModuleHandleExW(GET_MODULE_HANDLE_EX_FLAG_FROM_ADDRESS | GET_MODULE_HANDLE_EX_FLAG_UNCHANGED_REFCOUNT,
                           (LPCWSTR)(const void *)hold_own_code, &code))
        FreeLibrary(code);
}

/* A thread that ends takes the loader's lock, which whoever unloads a library has: to join threads there would never end. So a thread keeps the library
 * loaded until it was joined, and the host that called for that has the library, too. Windows sends no signals to threads. */
bool thread_start(pthread_t *thread, void *(*run)(void *), void *context)
{
    if (!hold_own_code()) return false;
    const bool started = pthread_create(thread, NULL, run, context) == 0;
    if (!started) let_go_of_own_code();
    return started;
}

void thread_join(pthread_t thread)
{
    pthread_join(thread, NULL);
    let_go_of_own_code();
}
