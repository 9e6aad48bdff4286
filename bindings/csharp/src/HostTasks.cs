using System;
using System.Collections.Concurrent;
using System.Runtime.InteropServices;
using AOT;
using Pbmpm.Native;

namespace Pbmpm
{
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
        readonly bool nests;

        /// <param name="enqueue">Called by any thread that calls the library, and by that of a step in the background, which may be a
        /// task.</param>
        /// <param name="finish">Called by the same thread; for a step that is a task by the one that ends the step or disposes of the
        /// world. In a task it has to run other tasks while it waits, or some worker has to be left that does.</param>
        /// <param name="nests">Whether a task may itself enqueue tasks and finish them. Then a step in the background is one, and
        /// its world has no thread for it.</param>
        public HostTasks(EnqueueTasks enqueue, FinishTasks finish, bool nests = false)
        {
            this.nests = nests;
            this.enqueue = enqueue ?? throw new ArgumentNullException(nameof(enqueue));
            this.finish = finish ?? throw new ArgumentNullException(nameof(finish));
        }

        /// <summary>`tasks` null: they are not given to the library.</summary>
        internal static TaskHooks Hooks(HostTasks tasks, IntPtr user)
        {
            return new TaskHooks
            {
                Size = (uint)sizeof(TaskHooks),
                Nests = tasks != null && tasks.nests ? 1 : 0,
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
                return Fatal.End(problem);
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
                Fatal.End(problem);
            }
        }
    }
}
