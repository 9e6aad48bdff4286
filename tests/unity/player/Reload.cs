using System;
using System.Reflection;
using UnityEngine;

/// <summary>Plays in application domains that are unloaded, as the editor does when it loads scripts anew: after an orderly end, and in the
/// midst of a step in the background. What comes after has to come to the same. The process has to live.</summary>
public sealed class Reload : MarshalByRefObject
{
    const int Played = 20;

    static int Main()
    {
        var first = InDomain(true, false);
        var hashes = new[] { InDomain(true, true), InDomain(false, true), InDomain(true, false), new Reload().Play(true, false), new Reload().Play(true, true) };
        Console.WriteLine("hash {0:x16}; after reloads, and after plays in one domain: {1}", first, string.Join(" ", Array.ConvertAll(hashes, one => one.ToString("x16"))));
        return Array.TrueForAll(hashes, one => one == first) ? 0 : 1;
    }

    static ulong InDomain(bool orderly, bool background)
    {
        var domain = AppDomain.CreateDomain("scripts");
        var there = (Reload)domain.CreateInstanceAndUnwrap(Assembly.GetExecutingAssembly().FullName, typeof(Reload).FullName);
        var hash = there.Play(orderly, background);
        AppDomain.Unload(domain);
        return hash;
    }

    public ulong Play(bool orderly, bool background)
    {
        Player.Play(Assembly.Load("Pbmpm.Components"));
        var scene = new Scene.OfComponents(background);
        for (var frame = 0; frame < Played; frame++)
        {
            scene.Advance(frame);
            GC.KeepAlive(scene.World.Simulation);
        }
        var hash = scene.World.Simulation.StateHash;
        scene.Advance(Played); // in the background: leaves a step under way
        if (orderly) Player.Stop();
        return hash;
    }
}
