using System;
using System.Collections.Concurrent;
using System.Runtime.InteropServices;
using AOT;
using Pbmpm.Native;

// What a host lends to a world: memory and its job system. The library calls static functions, which compilers ahead of
// time need; they find the host's object by the address of its handle.
namespace Pbmpm
{
    /// <summary>Returns a block of at least <paramref name="size"/> bytes at a multiple of <paramref name="alignment"/>, or zero.</summary>
    public delegate IntPtr AllocateMemory(long size, long alignment);

    /// <summary>Takes back a block of the size that was asked for.</summary>
    public delegate void ReleaseMemory(IntPtr memory, long size);

    /// <summary>Begins tasks and returns what <see cref="FinishTasks"/> knows them by; null will do.</summary>
    public delegate object EnqueueTasks(TaskBatch batch);

    /// <summary>Returns when all tasks of a handle have returned.</summary>
    public delegate void FinishTasks(object handle);

    /// <summary>Parallel work of a step: <see cref="Run"/> is to be called once for each index in [0, <see cref="Count"/>), on any
    /// threads and in any order, before <see cref="FinishTasks"/> returns.</summary>
    public readonly struct TaskBatch
    {
        /// <summary>The few functions of the library that are tasks, so that a step makes no garbage.</summary>
        static readonly ConcurrentDictionary<long, Task> Known = new ConcurrentDictionary<long, Task>();

        readonly Task task;
        readonly IntPtr context;

        internal TaskBatch(IntPtr task, int count, IntPtr context)
        {
            if (!Known.TryGetValue((long)task, out this.task))
                this.task = Known[(long)task] = (Task)Marshal.GetDelegateForFunctionPointer(task, typeof(Task));
            this.context = context;
            Count = count;
        }

        /// <summary>How many tasks there are.</summary>
        public int Count { get; }

        /// <summary>Does one of them.</summary>
        public void Run(int index)
        {
            task(index, context);
        }
    }

    /// <summary>A job system of the host. Its functions are kept until the worlds that use it are destroyed. They must not throw:
    /// an exception there ends the process, since none can pass the library.</summary>
    public sealed unsafe class HostTasks
    {
        static readonly TaskHooksEnqueue EnqueueEntry = OnEnqueue;
        static readonly TaskHooksFinish FinishEntry = OnFinish;

        readonly EnqueueTasks enqueue;
        readonly FinishTasks finish;

        /// <param name="enqueue">Called by the thread that steps, and by that of a step in the background.</param>
        /// <param name="finish">Called by the same thread.</param>
        public HostTasks(EnqueueTasks enqueue, FinishTasks finish)
        {
            this.enqueue = enqueue ?? throw new ArgumentNullException(nameof(enqueue));
            this.finish = finish ?? throw new ArgumentNullException(nameof(finish));
        }

        internal static TaskHooks Hooks(IntPtr user)
        {
            return new TaskHooks
            {
                Size = (uint)sizeof(TaskHooks),
                Enqueue = Marshal.GetFunctionPointerForDelegate(EnqueueEntry),
                Finish = Marshal.GetFunctionPointerForDelegate(FinishEntry),
                User = user,
            };
        }

        [MonoPInvokeCallback(typeof(TaskHooksEnqueue))]
        static IntPtr OnEnqueue(IntPtr task, int count, IntPtr context, IntPtr user)
        {
            try
            {
                var handle = Lent.At<HostTasks>(user).enqueue(new TaskBatch(task, count, context));
                return handle == null ? IntPtr.Zero : GCHandle.ToIntPtr(GCHandle.Alloc(handle));
            }
            catch (Exception problem)
            {
                return Lent.End(problem);
            }
        }

        [MonoPInvokeCallback(typeof(TaskHooksFinish))]
        static void OnFinish(IntPtr handle, IntPtr user)
        {
            try
            {
                Lent.At<HostTasks>(user).finish(handle == IntPtr.Zero ? null : GCHandle.FromIntPtr(handle).Target);
                if (handle != IntPtr.Zero) GCHandle.FromIntPtr(handle).Free();
            }
            catch (Exception problem)
            {
                Lent.End(problem);
            }
        }
    }

    /// <summary>Memory of the host. Its functions are kept until the worlds that use it are destroyed; for one world they are
    /// never called by two threads at once. They must not throw: an exception there ends the process, since none can pass the
    /// library.</summary>
    public sealed unsafe class HostMemory
    {
        static readonly AllocatorAllocate AllocateEntry = OnAllocate;
        static readonly AllocatorRelease ReleaseEntry = OnRelease;

        readonly AllocateMemory allocate;
        readonly ReleaseMemory release;

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
                return Lent.End(problem);
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
                Lent.End(problem);
            }
        }
    }

    /// <summary>The handles by which the library reaches what a host lent to one world.</summary>
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

        /// <summary>Ends the process with a message instead of letting an exception run into native code.</summary>
        public static IntPtr End(Exception problem)
        {
            Environment.FailFast("pbmpm: a function of the host threw, and no exception can pass the library: " + problem);
            return IntPtr.Zero;
        }
    }
}
