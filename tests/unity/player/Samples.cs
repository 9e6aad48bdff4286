using System;
using System.Reflection;
using Pbmpm.Components;
using UnityEngine;

/// <summary>Samples.exe [FRAMES]: plays each sample of the package, and tells how it stands then. Ends with 1 if one complains, or its matter is lost.</summary>
static class Samples
{
    static bool fails;

    static int Main(string[] words)
    {
        var frames = words.Length > 0 ? int.Parse(words[0]) : 120;
        Play<PourADrink>(frames, 1000);
        Input.Held = true;
        Play<Sandbox>(frames, 10000);
        Play<RaftOnARiver>(frames, 10000);
        return fails ? 1 : 0;
    }

    static void Play<T>(int frames, int least) where T : MonoBehaviour
    {
        UnityEngine.Debug.Told.Clear();
        Player.Play(Assembly.Load("Pbmpm.Components"));
        new GameObject("camera").AddComponent<Camera>();
        new GameObject(typeof(T).Name).AddComponent<T>();
        for (var frame = 0; frame < frames; frame++) Player.Frame(1 / 60f);
        var world = PbmpmWorld.First;
        var stats = world.Simulation.Stats;
        Console.WriteLine("{0}: {1} particles, {2:F2} s, {3:F1} ms a step, volume error {4:F1} %, at most {5:F2} m/s", typeof(T).Name, stats.ParticleCount,
                          stats.SimulatedSeconds, stats.MsTotal, stats.VolumeErrorRms * 100, stats.MaxSpeed);
        foreach (var body in UnityEngine.Object.FindObjectsOfType<PbmpmRigidbody>())
            Console.WriteLine("  {0}: {1}, {2:F2} submerged", body.name, body.transform.position, body.Submerged);
        foreach (var note in world.Simulation.Advice(world.StepSeconds)) Console.WriteLine("  advice: " + note);
        foreach (var line in UnityEngine.Debug.Told) Console.WriteLine("  told: " + line);
        fails |= UnityEngine.Debug.Told.Count > 0 || stats.ParticleCount < least || stats.DeletedTotal > 0;
        Player.Stop();
    }
}
