using System;
using System.Diagnostics;
using System.Reflection;
using Pbmpm.Components;
using UnityEngine;

/// <summary>Frames.exe [FRAMES] [background] [litter]: plays the scene of components, and tells how long frames took, how much garbage they
/// made, and the hash of the state beside that of the C# binding. Ends with 1 if there is garbage or the hashes differ. With "litter"
/// each frame makes 64 bytes of garbage, which has to be seen.</summary>
static class Frames
{
    const int WarmUp = 100;

    static int Main(string[] words)
    {
        var frames = words.Length > 0 ? int.Parse(words[0]) : 1000;
        var background = Array.IndexOf(words, "background") >= 0;
        var litter = Array.IndexOf(words, "litter") >= 0;
        if (background) UnityEngine.Rendering.GraphicsSettings.currentRenderPipeline = ScriptableObject.CreateInstance<Pipeline>();
        Player.Play(Assembly.Load("Pbmpm.Components"));
        var scene = new Scene.OfComponents(background);
        for (var frame = 0; frame < WarmUp; frame++) Advance(scene, frame, litter);

        var times = new double[frames];
        var garbage = new Garbage();
        garbage.Begin();
        for (var frame = 0; frame < frames; frame++) times[frame] = Advance(scene, WarmUp + frame, litter);
        var bytes = garbage.Bytes();

        UnityEngine.GUI.Shown = new System.Collections.Generic.List<string>();
        Player.Frame(0);
        Console.WriteLine("HUD: " + string.Join("", UnityEngine.GUI.Shown.ToArray()));
        var world = scene.World;
        var particles = world.ParticleCount;
        var hash = world.Simulation.StateHash;
        var steps = (int)world.Statistics.StepCount;
        var late = world.LateFrames;
        Player.Stop();
        var start = Stopwatch.GetTimestamp();
        var wanted = Scene.HashOfCalls(steps);
        var alone = (Stopwatch.GetTimestamp() - start) * 1000.0 / Stopwatch.Frequency / steps;
        Array.Sort(times);
        Console.WriteLine("{0} frames after {1}, {2} steps{3}, {4} particles: {5:F2} ms median, {6:F2} ms 99 %, {7:F2} ms longest, {8:F2} ms mean", frames, WarmUp, steps,
                          background ? " in the background, " + late + " late frames" : "", particles, times[frames / 2], times[frames * 99 / 100], times[frames - 1], Mean(times));
        Console.WriteLine("the same by the C# binding alone: {0:F2} ms a step, mean", alone);
        Console.WriteLine("{0} instances drawn, {1} buffers left", UnityEngine.Graphics.Drawn, ComputeBuffer.Alive);
        Console.WriteLine("garbage: {0} bytes, by {1}", bytes, garbage.Way);
        Console.WriteLine("hash {0:x16}, by the C# binding {1:x16}", hash, wanted);
        foreach (var line in UnityEngine.Debug.Told) Console.WriteLine("told: " + line);
        return bytes == 0 && hash == wanted && ComputeBuffer.Alive == 0 && UnityEngine.Debug.Told.Count == 0 ? 0 : 1;
    }

    static double Mean(double[] times)
    {
        var sum = 0.0;
        foreach (var one in times) sum += one;
        return sum / times.Length;
    }

    /// <summary>A frame; returns its ms. A step in the background is waited for after it, as in a game whose frames take longer than a step.</summary>
    static double Advance(Scene.OfComponents scene, int frame, bool litter)
    {
        var begin = Stopwatch.GetTimestamp();
        scene.Advance(frame);
        var ms = (Stopwatch.GetTimestamp() - begin) * 1000.0 / Stopwatch.Frequency;
        GC.KeepAlive(scene.World.Simulation);
        if (litter) GC.KeepAlive(new byte[64]);
        return ms;
    }
}

/// <summary>Has renderers take the way of the scriptable pipelines.</summary>
sealed class Pipeline : UnityEngine.Rendering.RenderPipelineAsset
{
}

/// <summary>Bytes of managed memory that were asked for since it began.</summary>
sealed class Garbage
{
    readonly Func<long> count;
    long begun;
    int collections;

    public Garbage()
    {
        var exact = typeof(GC).GetMethod("GetAllocatedBytesForCurrentThread");
        if (exact != null) count = (Func<long>)Delegate.CreateDelegate(typeof(Func<long>), exact);
        Way = exact != null ? "bytes allocated by the thread" : "growth of the heap and collections";
    }

    public string Way { get; }

    public void Begin()
    {
        GC.Collect();
        GC.WaitForPendingFinalizers();
        collections = GC.CollectionCount(0);
        begun = Now();
        begun = Now();
    }

    public long Bytes()
    {
        var grown = Now() - begun;
        return GC.CollectionCount(0) == collections ? grown : Math.Max(1, grown);
    }

    long Now()
    {
        return count != null ? count() : GC.GetTotalMemory(false);
    }
}
