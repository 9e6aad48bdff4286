using System;
using System.Collections.Generic;
using System.Reflection;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Threading;
using System.Threading.Tasks;
using Pbmpm;

/// <summary>What a host lends to the library: its job system, its memory, its log. And calls that come in the middle of a step.</summary>
static class HostTests
{
    /// <summary>A 3D world, full enough that the library shares the work out to the host.</summary>
    static World FullWorld(HostTasks tasks)
    {
        var definition = WorldDef.Default;
        definition.ParticleCapacity = 70000;
        definition.ThreadCount = 2;
        var world = new World(definition, tasks);
        var fill = Scenes.Water(world);
        Expect.Equal(64000, world.Fill(fill, Shape.Box(new Float3(1, 1, 1), new Float3(1, 1, 1))), "particles");
        return world;
    }

    static object RunAtOnce(TaskBatch batch)
    {
        for (var i = 0; i < batch.Count; i++) batch.Run(i);
        return null;
    }

    static void Nothing(object handle)
    {
    }

    [Test]
    static void AWorldInTheMiddleOfAStepIsBusy()
    {
        World world = null;
        var refused = 0;
        Result result = Result.Ok;
        var tasks = new HostTasks(batch =>
        {
            try
            {
                world?.Close();
            }
            catch (PbmpmException problem)
            {
                result = problem.Result;
                refused++;
            }
            return RunAtOnce(batch);
        }, Nothing);
        using (world = FullWorld(tasks))
        {
            world.Step(Scenes.Frame);
            Expect.True(refused > 0, "the host ran tasks and the world refused to be closed");
            Expect.Equal(Result.ErrorBusy, result, "what it said");
            Expect.True(!world.IsDisposed, "it is still there");
            Expect.Equal(1ul, world.Stats.StepCount, "steps");
        }
        Expect.True(world.IsDisposed, "afterwards it can be disposed of");
    }

    [Test]
    static void DisposingHidesNoException()
    {
        World world = null;
        int seen = 0, batches = 0;
        var tasks = new HostTasks(batch =>
        {
            batches++;
            try
            {
                using (world) throw new FailedTest("the first exception");
            }
            catch (FailedTest)
            {
                seen++;
            }
            catch (PbmpmException)
            {
            }
            return RunAtOnce(batch);
        }, Nothing);
        using (world = FullWorld(tasks))
        {
            world.Step(Scenes.Frame);
            Expect.True(seen > 0, "the host ran tasks");
            Expect.Equal(batches, seen, "times that the first exception came through");
            Expect.True(!world.IsDisposed, "a world that is busy stays");
        }
    }

    [Test]
    static void ThreadsOfTheHostDoTheWork()
    {
        var handles = new List<object>();
        var tasks = new HostTasks(batch => Task.Run(() => Parallel.For(0, batch.Count, batch.Run)), handle =>
        {
            handles.Add(handle);
            ((Task)handle).Wait();
        });
        ulong alone;
        using (var world = FullWorld(null))
        {
            world.Step(Scenes.Frame);
            alone = world.StateHash;
        }
        using (var world = FullWorld(tasks))
        {
            world.Step(Scenes.Frame);
            Expect.Equal(alone, world.StateHash, "hash");
        }
        Expect.True(handles.Count > 0 && !handles.Contains(null), "handles come back");
    }

    [Test]
    static void ABackgroundStepIsATaskWhereTasksNest()
    {
        int single = 0, finished = 0;
        var tasks = new HostTasks(batch =>
        {
            if (batch.Count == 1) Interlocked.Increment(ref single);
            return Task.Run(() => Parallel.For(0, batch.Count, batch.Run));
        }, handle =>
        {
            ((Task)handle).Wait();
            Interlocked.Increment(ref finished);
        }, true);
        ulong alone;
        using (var world = FullWorld(null))
        {
            world.Step(Scenes.Frame);
            alone = world.StateHash;
        }
        using (var world = FullWorld(tasks))
        {
            world.BeginStep(Scenes.Frame);
            world.EndStep();
            Expect.Equal(alone, world.StateHash, "hash");
            Expect.Equal(1, single, "steps that were tasks");
            Expect.True(finished > 1, "it had tasks of its own");
        }
    }

    [Test]
    static void AWorldKeepsWhatTheHostLentToIt()
    {
        var blocks = new Blocks();
        var world = Lend(blocks, out var tasks, out var memory);
        Collect();
        Expect.True(tasks.IsAlive && memory.IsAlive, "they are alive while the world is");
        world.Step(Scenes.Frame);
        Expect.True(blocks.Living > 0, "the world is in the host's memory");
        world.Dispose();
        Expect.Equal(0, blocks.Living, "blocks of a world that is gone");
        Collect();
        Expect.True(!tasks.IsAlive && !memory.IsAlive, "nobody holds them any more");
    }

    [Test]
    static void ARefusedWorldKeepsNothing()
    {
        var memory = RefusedWorld();
        Collect();
        Expect.True(!memory.IsAlive, "nobody holds it");
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    static World Lend(Blocks blocks, out WeakReference tasks, out WeakReference memory)
    {
        var definition = WorldDef.Default;
        definition.ParticleCapacity = 100;
        var lentTasks = new HostTasks(RunAtOnce, Nothing);
        var lentMemory = blocks.Memory();
        tasks = new WeakReference(lentTasks);
        memory = new WeakReference(lentMemory);
        return new World(definition, lentTasks, lentMemory);
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    static WeakReference RefusedWorld()
    {
        var definition = WorldDef.Default;
        definition.CellSize = float.NaN;
        var memory = new Blocks().Memory();
        Expect.Refused(Result.ErrorInvalidArgument, () => new World(definition, null, memory), "a cell size of NaN");
        return new WeakReference(memory);
    }

    /// <summary>On a deeper stack, so that no address of before is left on it.</summary>
    static void Collect()
    {
        var thread = new Thread(() =>
        {
            for (var i = 0; i < 3; i++)
            {
                GC.Collect();
                GC.WaitForPendingFinalizers();
            }
        });
        thread.Start();
        thread.Join();
    }

    [Test]
    static void MemoryThatTheHostRefusesIsMissing()
    {
        var memory = new HostMemory((size, alignment) => IntPtr.Zero, (block, size) => { });
        Expect.Refused(Result.ErrorOutOfMemory, () => new World(WorldDef.Default, null, memory), "a world without memory");
    }

    [Test]
    static void TheLogTellsOfRefusals()
    {
        var lines = new List<string>();
        using (var world = Scenes.Box(2))
        {
            Library.Log = (level, line) =>
            {
                Expect.Equal(LogLevel.Error, level, "how grave it is");
                lines.Add(line);
            };
            Collect();
            Expect.Refused(Result.ErrorInvalidArgument, () => world.Step(-1), "a step back");
            Library.Log = null;
            Expect.Refused(Result.ErrorInvalidArgument, () => world.Step(-1), "another one");
        }
        Expect.Equal(1, lines.Count, "lines");
        Expect.True(lines[0].Contains("dt"), "it says what was wrong: " + lines[0]);
    }

    /// <summary>Compilers ahead of time make an entry only for static functions that are marked.</summary>
    [Test]
    static void WhatTheLibraryCallsIsMarked()
    {
        var entries = new HashSet<MethodInfo>(); // compilers keep delegates of their own
        foreach (var type in typeof(World).Assembly.GetTypes())
        foreach (var field in type.GetFields(BindingFlags.Static | BindingFlags.NonPublic))
        {
            if (!field.FieldType.IsDefined(typeof(UnmanagedFunctionPointerAttribute), false)) continue;
            var entry = ((Delegate)field.GetValue(null)).Method;
            entries.Add(entry);
            Expect.True(entry.IsStatic && entry.IsDefined(typeof(AOT.MonoPInvokeCallbackAttribute), false), entry.Name);
        }
        Expect.Equal(5, entries.Count, "functions that the library calls");
    }
}
