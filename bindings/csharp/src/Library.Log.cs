using System;
using System.Runtime.InteropServices;
using AOT;
using Pbmpm.Native;

namespace Pbmpm
{
    // The library's log
    public static unsafe partial class Library
    {
        static readonly LogCallback LogEntry = OnLog;
        static volatile Action<LogLevel, string> log;

        static Library()
        {
            DomainEnd.Calls(TakeOffLog);
        }

        /// <summary>Receives one line per notable happening, and how grave it is. Null, the default: nobody does. There is one
        /// in a process: that of the last domain that set it. Not to be set while another thread is inside the library.
        /// It may be called by any thread that calls the library and by a step in the background. It must not call the library,
        /// and not throw: an exception there ends the process.</summary>
        public static Action<LogLevel, string> Log
        {
            get => log;
            set
            {
                Check();
                var entry = value == null ? IntPtr.Zero : Marshal.GetFunctionPointerForDelegate(LogEntry);
                Require(Methods.pbmpm_set_log_callback(entry, IntPtr.Zero));
                log = value;
            }
        }

        static void TakeOffLog(object sender, EventArgs nothing)
        {
            if (log != null) Log = null;
        }

        [MonoPInvokeCallback(typeof(LogCallback))]
        static void OnLog(LogLevel level, IntPtr message, IntPtr user)
        {
            try
            {
                log?.Invoke(level, Text(message));
            }
            catch (Exception problem)
            {
                Fatal.End(problem);
            }
        }
    }
}
