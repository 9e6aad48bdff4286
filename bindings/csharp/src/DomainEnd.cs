using System;

namespace Pbmpm
{
    /// <summary>The end of this domain or of the process, whichever comes: what the library still knows of the domain has to go
    /// before.</summary>
    internal static class DomainEnd
    {
        public static void Calls(EventHandler cleaner)
        {
            AppDomain.CurrentDomain.DomainUnload += cleaner;
            AppDomain.CurrentDomain.ProcessExit += cleaner;
        }
    }
}
