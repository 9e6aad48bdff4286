using System;
using System.Runtime.InteropServices;
using AOT;
using Pbmpm.Native;

namespace Pbmpm
{
    /// <summary>Returns a block of at least <paramref name="size"/> bytes at a multiple of <paramref name="alignment"/>, or zero.</summary>
    public delegate IntPtr AllocateMemory(long size, long alignment);

    /// <summary>Takes back a block of the size that was asked for.</summary>
    public delegate void ReleaseMemory(IntPtr memory, long size);

    /// <summary>Memory of the host. Its functions are kept until the worlds that use it are destroyed; for one world they are
    /// never called by two threads at once. They must not throw: an exception there ends the process, since none can pass the
    /// library.</summary>
    public sealed unsafe class HostMemory
    {
        static readonly AllocatorAllocate AllocateEntry = OnAllocate;
        static readonly AllocatorRelease ReleaseEntry = OnRelease;

        readonly AllocateMemory allocate;
        readonly ReleaseMemory release;

        /// <param name="allocate">Called by the thread that calls the library, and by that of a step in the background.</param>
        /// <param name="release">Called by the same, and by whoever destroys the world: its finalizer too.</param>
        public HostMemory(AllocateMemory allocate, ReleaseMemory release)
        {
            this.allocate = allocate ?? throw new ArgumentNullException(nameof(allocate));
            this.release = release ?? throw new ArgumentNullException(nameof(release));
        }

        internal static Allocator Hooks(IntPtr user)
        {
            return new Allocator
            {
                Size = (uint)sizeof(Allocator),
                Allocate = Marshal.GetFunctionPointerForDelegate(AllocateEntry),
                Release = Marshal.GetFunctionPointerForDelegate(ReleaseEntry),
                User = user,
            };
        }

        [MonoPInvokeCallback(typeof(AllocatorAllocate))]
        static IntPtr OnAllocate(UIntPtr size, UIntPtr alignment, IntPtr user)
        {
            try
            {
                return Lent.At<HostMemory>(user).allocate((long)size, (long)alignment);
            }
            catch (Exception problem)
            {
                return Fatal.End(problem);
            }
        }

        [MonoPInvokeCallback(typeof(AllocatorRelease))]
        static void OnRelease(IntPtr memory, UIntPtr size, IntPtr user)
        {
            try
            {
                Lent.At<HostMemory>(user).release(memory, (long)size);
            }
            catch (Exception problem)
            {
                Fatal.End(problem);
            }
        }
    }
}
