using System;
using System.Runtime.InteropServices;

namespace Pbmpm
{
    /// <summary>The handles by which the library reaches what a host lent to one world. It calls static functions, which compilers ahead
    /// of time need; they find the host's object by its handle.</summary>
    internal struct Lent
    {
        GCHandle tasks;
        GCHandle memory;

        public Lent(HostTasks tasks, HostMemory memory)
        {
            this.tasks = tasks == null ? default(GCHandle) : GCHandle.Alloc(tasks);
            this.memory = memory == null ? default(GCHandle) : GCHandle.Alloc(memory);
        }

        public IntPtr Tasks => tasks.IsAllocated ? GCHandle.ToIntPtr(tasks) : IntPtr.Zero;
        public IntPtr Memory => memory.IsAllocated ? GCHandle.ToIntPtr(memory) : IntPtr.Zero;

        /// <summary>To be called once the library knows the world no more.</summary>
        public void Return()
        {
            if (tasks.IsAllocated) tasks.Free();
            if (memory.IsAllocated) memory.Free();
        }

        public static T At<T>(IntPtr user)
        {
            return (T)GCHandle.FromIntPtr(user).Target;
        }
    }
}
