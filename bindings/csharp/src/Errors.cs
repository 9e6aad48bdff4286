using System;

namespace Pbmpm
{
    /// <summary>A call that the C library refused. Unless the call says otherwise, the world is as it was before.</summary>
    public sealed class PbmpmException : Exception
    {
        internal PbmpmException(Result result, string name, string message) : base(name + ": " + message)
        {
            Result = result;
        }

        /// <summary>What the call came to.</summary>
        public Result Result { get; }
    }

    /// <summary>The native library is missing, or it does not fit this assembly.</summary>
    public sealed class LibraryException : Exception
    {
        internal LibraryException(string message, Exception cause = null) : base("pbmpm: " + message, cause)
        {
        }
    }

    /// <summary>A view was read after its world had changed or had been disposed of.</summary>
    public sealed class ExpiredViewException : InvalidOperationException
    {
        internal ExpiredViewException() : base("the world has changed since this view was taken; take a new one")
        {
        }
    }

    /// <summary>What happens to an exception of the host in a function that the library called.</summary>
    internal static class Fatal
    {
        /// <summary>Ends the process with a message instead of letting the exception run into native code.</summary>
        public static IntPtr End(Exception problem)
        {
            Environment.FailFast("pbmpm: a function of the host threw, and no exception can pass the library: " + problem);
            return IntPtr.Zero;
        }
    }
}
