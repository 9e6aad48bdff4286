using System;
using Pbmpm;
#if UNITY_5_3_OR_NEWER
using Vector3 = UnityEngine.Vector3;
#else
using Vector3 = System.Numerics.Vector3;
#endif

/// <summary>The host's vectors go in and out, in 2D without their third number.</summary>
static class VectorTests
{
    static readonly Vector3[] Places = { new Vector3(0.5f, 1, 0.7f), new Vector3(1.5f, 1, 0.7f) };
    static readonly Vector3[] Speeds = { new Vector3(1, 2, 3), new Vector3(4, 5, 6) };

    [Test]
    static void VectorsAreThoseOfTheBinding()
    {
        Float3 there = new Vector3(1, 2, 3);
        Expect.Equal(3f, there.Z, "third number");
        Vector3 back = there;
        Expect.Equal(new Vector3(1, 2, 3), back, "and back");
    }

    [Test]
    static void ArraysOfVectorsServeAsThoseOfNumbers()
    {
        InBoth(world =>
        {
            var ids = new ParticleId[2];
            world.AddParticles(world.AddMaterial(MaterialDef.Default), Places, Speeds, null, ids);
            Expect.Equal(world.Particles[1], ids[1], "identifier");
            ExpectVectors(world, world.Positions, Places);
            ExpectVectors(world, world.Velocities, Speeds);
            world.Set(Field.Velocity, Places);
            ExpectVectors(world, world.Velocities, Places);
            world.Set(Field.Velocity, ids, Speeds);
            ExpectVectors(world, world.Velocities, Speeds);
        });
    }

    [Test]
    static void ArraysOfVectorsAskWhereMatterIs()
    {
        foreach (var dimension in new[] { 2, 3 })
        using (var world = Scenes.Pool(dimension))
        {
            Vector3[] points = { new Vector3(1, 1, 1), new Vector3(0.2f, 0.2f, 0.2f) };
            float[] filling = new float[2], density = new float[2], heights = new float[2];
            var velocity = new Vector3[2];
            world.Step(Scenes.Frame);
            world.QueryPoints(points, filling, density, velocity);
            Expect.Near(1, filling[0], 0.2, "filling inside");
            Expect.Equal(0f, density[1], "density outside");
            Expect.Near(-10 * Scenes.Frame, ((Float3)velocity[0]).Y, 0.02, "velocity inside");
            Expect.Near(0, ((Float3)velocity[0]).Z, 0.02, "its third number");
            world.QueryHeights(points, heights);
            Expect.Near(1.2, heights[0], 0.05, "height");
        }
    }

    [Test]
    static void VectorsThatDoNotFitAreRefused()
    {
        using (var world = Scenes.Pool(3))
        {
            var water = world.AddMaterial(MaterialDef.Default);
            var problem = Expect.Throws<ArgumentException>(() => world.Set(Field.Velocity, Speeds), "too few values");
            Expect.True(problem.Message.Contains("the length is 2 instead of " + world.ParticleCount), problem.Message);
            problem = Expect.Throws<ArgumentException>(() => world.Positions.CopyTo(new Vector3[2]), "too little room");
            Expect.True(problem.Message.Contains("the length is 2, too few for " + world.ParticleCount), problem.Message);
            Expect.Throws<ArgumentException>(() => world.AddParticles(water, Places, new Vector3[1]), "too few velocities");
            Expect.Throws<ArgumentException>(() => world.View(Field.VolumeRatio).CopyTo(new Vector3[9999]), "vectors of numbers");
            Expect.Throws<ArgumentNullException>(() => world.AddParticles(water, (Vector3[])null), "no places");
            Expect.Throws<ArgumentNullException>(() => world.Set(Field.Velocity, (Vector3[])null), "no values");
        }
    }

#if PBMPM_SPANS
    [Test]
    static void SpansServeAsArrays()
    {
        InBoth(world =>
        {
            ReadOnlySpan<Vector3> places = Places, speeds = Speeds;
            var ids = new ParticleId[2];
            var water = world.AddMaterial(MaterialDef.Default);
            world.AddParticles(water, places, ids: ids.AsSpan());
            Expect.Equal(world.Particles[1], ids[1], "identifier");
            ExpectVectors(world, world.Positions, Places);
            Expect.Equal(0f, world.Velocities[1, 0], "velocity when none is named");
            world.Set(Field.Velocity, speeds);
            ExpectVectors(world, world.Velocities, Speeds);
            world.Set(Field.Velocity, new ReadOnlySpan<ParticleId>(ids), places);
            ExpectVectors(world, world.Velocities, Places);

            var numbers = new float[2 * world.Dimension + 1];
            var room = new Span<float>(numbers, 1, 2 * world.Dimension);
            world.Positions.CopyTo(room);
            Expect.Equal(0f, numbers[0], "what lies before the span");
            Expect.Equal(1.5f, room[world.Dimension], "place");
            world.Set(Field.Velocity, (ReadOnlySpan<float>)room);
            ExpectVectors(world, world.Velocities, Places);
            world.Set(Field.Velocity, new ReadOnlySpan<ParticleId>(ids, 1, 1), ((ReadOnlySpan<float>)room).Slice(0, world.Dimension));
            Expect.Equal(0.5f, world.Velocities[1, 0], "velocity of the second");
            world.AddParticles(water, (ReadOnlySpan<float>)room);
            Expect.Equal(4, world.ParticleCount, "particles");

            var seen = new Vector3[5];
            world.Positions.CopyTo(new Span<Vector3>(seen, 1, 4));
            Expect.Equal(0.5f, ((Float3)seen[1]).X, "place in a span of vectors");
        });
    }

    [Test]
    static void SpansAskWhereMatterIs()
    {
        using (var world = Scenes.Pool(2))
        {
            ReadOnlySpan<Vector3> points = new[] { new Vector3(1, 1, 1) };
            var figure = new float[1];
            world.QueryPoints(points, figure);
            Expect.Near(1, figure[0], 0.2, "filling");
            world.QueryHeights(points, figure);
            Expect.Near(1.2, figure[0], 0.05, "height");
        }
    }
#endif

    static void InBoth(Action<World> test)
    {
        foreach (var dimension in new[] { 2, 3 })
            using (var world = Scenes.Box(dimension)) test(world);
    }

    /// <summary>The view holds these vectors, and its copy does.</summary>
    static void ExpectVectors(World world, FloatView view, Vector3[] expected)
    {
        var copy = new Vector3[expected.Length];
        view.CopyTo(copy);
        for (var i = 0; i < expected.Length; i++)
        {
            Float3 wanted = expected[i], found = copy[i];
            Expect.Equal(wanted.X, view[i, 0], "first number");
            Expect.Equal(wanted.X, found.X, "first number of the copy");
            Expect.Equal(wanted.Y, found.Y, "second number of the copy");
            Expect.Equal(world.Dimension == 3 ? wanted.Z : 0, found.Z, "third number of the copy");
        }
    }
}
