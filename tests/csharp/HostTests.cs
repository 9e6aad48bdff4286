using System;
using System.Runtime.InteropServices;
using Pbmpm;
using Pbmpm.Native;

/// <summary>A host that gives the library its own task system, and calls that come in the middle of a step.</summary>
static class HostTests
{
    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    delegate IntPtr Enqueue(IntPtr task, int count, IntPtr context, IntPtr user);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    delegate void Finish(IntPtr handle, IntPtr user);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    delegate void Task(int index, IntPtr context);

    /// <summary>A 3D world, full enough that the library shares the work out to the host.</summary>
    static World FullWorld(Enqueue enqueue, Finish finish)
    {
        var definition = WorldDef.Default;
        definition.ParticleCapacity = 70000;
        definition.ThreadCount = 2;
        var tasks = new TaskHooks
        {
            Enqueue = Marshal.GetFunctionPointerForDelegate(enqueue),
            Finish = Marshal.GetFunctionPointerForDelegate(finish),
        };
        var world = new World(definition, tasks);
        var fill = Scenes.Water(world);
        Expect.Equal(64000, world.Fill(fill, Shape.Box(new Float3(1, 1, 1), new Float3(1, 1, 1))), "particles");
        return world;
    }

    [Test]
    static void AWorldInTheMiddleOfAStepIsBusy()
    {
        World world = null;
        var refused = 0;
        Result result = Result.Ok;
        Enqueue runAtOnce = (task, count, context, user) =>
        {
            try
            {
                world?.Dispose();
            }
            catch (PbmpmException problem)
            {
                result = problem.Result;
                refused++;
            }
            var run = (Task)Marshal.GetDelegateForFunctionPointer(task, typeof(Task));
            for (var i = 0; i < count; i++) run(i, context);
            return IntPtr.Zero;
        };
        Finish nothing = (handle, user) => { };
        using (world = FullWorld(runAtOnce, nothing))
        {
            world.Step(Scenes.Frame);
            Expect.True(refused > 0, "the host ran tasks and the world refused to be disposed of");
            Expect.Equal(Result.ErrorBusy, result, "what it said");
            Expect.True(!world.IsDisposed, "it is still there");
            Expect.Equal(1ul, world.Stats.StepCount, "steps");
        }
        Expect.True(world.IsDisposed, "afterwards it can be disposed of");
        GC.KeepAlive(runAtOnce);
        GC.KeepAlive(nothing);
    }
}
