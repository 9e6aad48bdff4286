using System;
using Pbmpm;
using Unity.Collections;
using UnityEngine;

/// <summary>What the binding has for Unity alone, with stand-ins for Unity's types.</summary>
static class UnityTests
{
    [Test]
    static void NativeArraysServeAsManagedOnes()
    {
        foreach (var dimension in new[] { 2, 3 })
        using (var world = Scenes.Box(dimension))
        using (var positions = Native(new Vector3(0.5f, 1, 0.7f), new Vector3(1.5f, 1, 0.7f)))
        using (var velocities = Native(new Vector3(1, 2, 3), new Vector3(4, 5, 6)))
        using (var ids = new NativeArray<ParticleId>(2, Allocator.Temp))
        using (var seen = new NativeArray<Vector3>(2, Allocator.Temp))
        {
            var water = world.AddMaterial(MaterialDef.Default);
            world.AddParticles(water, positions, velocities, default(NativeArray<float>), ids);
            var depth = dimension == 3 ? 1 : 0;
            world.Positions.CopyTo(seen);
            Expect.Equal(new Vector3(1.5f, 1, 0.7f * depth), seen[1], "place");
            world.Velocities.CopyTo(seen);
            Expect.Equal(new Vector3(4, 5, 6 * depth), seen[1], "velocity");
            world.Set(Field.Velocity, ids, positions);
            Expect.Equal(1.5f, world.Velocities[1, 0], "velocity that was set for some");
            world.Set(Field.Velocity, velocities);
            Expect.Equal(5f, world.Velocities[1, 1], "velocity that was set for all");
            Expect.Equal(world.Particles[1], ids[1], "identifier");
        }
    }

    [Test]
    static void NativeArraysAskWhereMatterIs()
    {
        foreach (var dimension in new[] { 2, 3 })
        using (var world = Scenes.Pool(dimension))
        using (var points = Native(new Vector3(1, 1, 1), new Vector3(0.2f, 0.2f, 0.2f)))
        using (var filling = new NativeArray<float>(2, Allocator.Temp))
        using (var velocity = new NativeArray<Vector3>(2, Allocator.Temp))
        {
            world.Step(Scenes.Frame);
            world.QueryPoints(points, filling, default(NativeArray<float>), velocity);
            Expect.Near(1, filling[0], 0.2, "filling inside");
            Expect.Equal(0f, filling[1], "filling outside");
            Expect.Near(-10 * Scenes.Frame, velocity[0].y, 0.02, "velocity inside");
            world.QueryHeights(points, filling);
            Expect.Near(1.2, filling[0], 0.05, "height");
        }
    }

    [Test]
    static void NativeArraysOfAWrongLengthAreRefused()
    {
        using (var world = Scenes.Pool(3))
        using (var one = new NativeArray<Vector3>(1, Allocator.Temp))
        {
            Expect.Throws<ArgumentException>(() => world.Set(Field.Velocity, one), "too few values");
            Expect.Throws<ArgumentException>(() => world.Positions.CopyTo(one), "too little room");
            Expect.Throws<ArgumentNullException>(() => world.Set(Field.Velocity, default(NativeArray<Vector3>)), "no array");
        }
    }

    static NativeArray<Vector3> Native(params Vector3[] elements)
    {
        return new NativeArray<Vector3>(elements, Allocator.Temp);
    }
}
