using System;
using Pbmpm;

/// <summary>Adding, removing, finding and viewing particles.</summary>
static class ParticleTests
{
    static readonly float[] TwoPlaces = { 0.5f, 0.6f, 1.5f, 1.25f };
    static readonly float[] TwoSpeeds = { 1, 2, 3, 4 };

    /// <summary>A world in 2D with two particles.</summary>
    static World Pair(ParticleId[] ids = null)
    {
        var world = Scenes.Box(2);
        world.AddParticles(world.AddMaterial(MaterialDef.Default), TwoPlaces, TwoSpeeds, null, ids);
        return world;
    }

    [Test]
    static void ViewsShowWhatWasAdded()
    {
        var ids = new ParticleId[2];
        using (var world = Pair(ids))
        {
            var rows = new uint[2];
            world.Find(ids, rows);
            FloatView positions = world.Positions, velocities = world.Velocities;
            Expect.Equal(2, positions.Count, "count");
            Expect.Equal(2, positions.Components, "components");
            for (var i = 0; i < 2; i++)
            {
                var row = (int)rows[i];
                for (var axis = 0; axis < 2; axis++)
                {
                    Expect.Near(TwoPlaces[2 * i + axis], positions[row, axis], 1e-6, "position");
                    Expect.Near(TwoSpeeds[2 * i + axis], velocities[row, axis], 1e-6, "velocity");
                }
                Expect.Equal(ids[i].Index, world.Particles[row].Index, "index");
                Expect.Equal(ids[i].Generation, world.Particles[row].Generation, "generation");
                Expect.Equal(positions[row, 1], positions.Vector(row).Y, "second component");
                Expect.Equal(0f, positions.Vector(row).Z, "third component in 2D");
                Expect.Equal(0u, world.Materials[row], "index of the material");
            }
        }
    }

    [Test]
    static unsafe void EveryFieldCanBeViewed()
    {
        using (var world = Scenes.Pool(3))
        {
            var elastic = MaterialDef.Default;
            elastic.Kind = MaterialKind.Elastic;
            world.AddParticles(world.AddMaterial(elastic), new[] { 0.3f, 0.3f, 0.3f }); // brings deformation gradients
            var settings = world.Settings;
            settings.Solver = Solver.Dual; // makes pressures
            world.Settings = settings;
            world.Step(0.01f);
            foreach (Field field in Enum.GetValues(typeof(Field)))
            {
                if (field == Field.Material || field == Field.Particle || field == Field.UserValue) continue;
                var view = world.View(field);
                var values = new float[view.Count * view.Components];
                view.CopyTo(values);
                for (var i = 0; i < values.Length; i++)
                {
                    int particle = i / view.Components, component = i % view.Components;
                    var there = (byte*)view.Data + particle * view.Stride + component * view.ComponentStride;
                    Expect.Equal(values[i], view[particle, component], field + " by index");
                    Expect.Equal(values[i], *(float*)there, field + " by address");
                }
            }
            Expect.Equal(1f, world.View(Field.Deformation)[0, 4], "a diagonal element");
            Expect.Throws<ArgumentException>(() => world.View(Field.Particle), "identifiers as floats");
            Expect.Throws<InvalidOperationException>(() => world.View(Field.Mass).Vector(0), "masses as vectors");
        }
    }

    [Test]
    static void AViewRefusesWhatItDoesNotHave()
    {
        using (var world = Pair())
        {
            var positions = world.Positions;
            Expect.Throws<ArgumentOutOfRangeException>(() => positions[2, 0].ToString(), "a third particle");
            Expect.Throws<ArgumentOutOfRangeException>(() => positions[-1, 0].ToString(), "a negative particle");
            Expect.Throws<ArgumentOutOfRangeException>(() => positions[0, 2].ToString(), "a third component");
            Expect.Throws<ArgumentException>(() => positions.CopyTo(new float[3]), "a short array");
            Expect.Throws<ExpiredViewException>(() => default(FloatView)[0, 0].ToString(), "a view of nothing");
        }
    }

    [Test]
    static void EveryChangeExpiresViews()
    {
        var ids = new ParticleId[2];
        using (var world = Pair(ids))
        {
            Action<World>[] changes =
            {
                w => w.Step(Scenes.Frame),
                w => w.Set(Field.Velocity, new float[4]),
                w => w.Set(Field.Velocity, ids, new float[4]),
                w => w.Fill(Scenes.Water(w), Scenes.Block),
                w => w.RemoveIn(Shape.Box(new Float3(1, 1, 0), new Float3(0.3f, 0.3f, 1))),
                w => w.Remove(ids, 1),
            };
            foreach (var change in changes)
            {
                var view = world.Positions;
                Expect.True(view.IsCurrent, "a new view is current");
                change(world);
                Expect.True(!view.IsCurrent, "an old view is not");
                Expect.Throws<ExpiredViewException>(() => view[0, 0].ToString(), "an expired view");
                Expect.Throws<ExpiredViewException>(() => view.CopyTo(new float[100]), "copying from an expired view");
            }
        }
    }

    [Test]
    static void WhatChangesNothingKeepsViews()
    {
        using (var world = Pair())
        {
            var view = world.Positions;
            Expect.Equal(2u, world.Stats.ParticleCount, "particles");
            Expect.Refused(Result.ErrorInvalidArgument, () => world.Step(float.NaN), "a step of NaN");
            Expect.True(view.IsCurrent, "the view is still current");
        }
    }

    [Test]
    static void SettingsOfFieldsArrive()
    {
        var ids = new ParticleId[2];
        using (var world = Pair(ids))
        {
            world.Set(Field.Velocity, new[] { ids[1] }, new float[] { 7, 8 });
            var rows = new uint[2];
            world.Find(ids, rows);
            Expect.Equal(7f, world.Velocities[(int)rows[1], 0], "the velocity that was set");
            Expect.Equal(1f, world.Velocities[(int)rows[0], 0], "the other one");
            world.Set(Field.VolumeRatio, new[] { 0.9f, 0.9f });
            Expect.Near(0.9, world.View(Field.VolumeRatio)[0, 0], 1e-6, "volume ratio");
            Expect.Refused(Result.ErrorInvalidArgument, () => world.Set(Field.Mass, new float[2]), "setting the mass");
        }
    }

    [Test]
    static void QueriesAndRemovalsAgree()
    {
        using (var world = Scenes.Pool(2))
        {
            var part = Shape.Box(new Float3(1, 1.1f, 0), new Float3(1, 0.1f, 1));
            var count = world.Query(part, new ParticleId[0]);
            Expect.True(count > 0 && count < world.ParticleCount, "some are inside");
            var ids = new ParticleId[count];
            Expect.Equal(count, world.Query(part, ids), "number with room");
            var before = world.ParticleCount;
            world.Remove(ids, 1);
            Expect.Equal(before - 1, world.ParticleCount, "after removing one");
            Expect.Equal(count - 1, world.RemoveIn(part), "removed");
            Expect.Refused(Result.ErrorInvalidId, () => world.Remove(ids), "removing them again");
        }
    }

    [Test]
    static void ArraysOfTheWrongLengthAreRefused()
    {
        var ids = new ParticleId[2];
        using (var world = Pair(ids))
        {
            var material = world.AddMaterial(MaterialDef.Default);
            Expect.Throws<ArgumentNullException>(() => world.AddParticles(material, (float[])null), "no positions");
            Expect.Throws<ArgumentException>(() => world.AddParticles(material, new float[3]), "half a position");
            Expect.Throws<ArgumentException>(() => world.AddParticles(material, TwoPlaces, new float[3]), "too few velocities");
            var one = new float[1];
            Expect.Throws<ArgumentException>(() => world.AddParticles(material, TwoPlaces, null, one), "too few volumes");
            var room = new ParticleId[1];
            Expect.Throws<ArgumentException>(() => world.AddParticles(material, TwoPlaces, ids: room), "no room for ids");
            Expect.Throws<ArgumentException>(() => world.Set(Field.Position, new float[3]), "too few values");
            Expect.Throws<ArgumentException>(() => world.Set(Field.Position, ids, new float[3]), "too few values for two");
            Expect.Throws<ArgumentException>(() => world.Find(ids, new uint[1]), "no room for rows");
            Expect.Throws<ArgumentException>(() => world.Remove(ids, 3), "more than there are");
            Expect.Equal(2, world.ParticleCount, "particles");
        }
    }

    [Test]
    static void EmptyArraysAreNothing()
    {
        using (var world = Pair())
        {
            world.AddParticles(world.AddMaterial(MaterialDef.Default), new float[0]);
            world.Remove(new ParticleId[0]);
            world.Find(new ParticleId[0], new uint[0]);
            world.Set(Field.Velocity, new ParticleId[0], new float[0]);
            Expect.Equal(2, world.ParticleCount, "particles");
        }
    }

    [Test]
    static void AFrameMakesNoGarbage()
    {
        using (var world = Scenes.Pool(3))
        {
            var buffer = new float[world.ParticleCount * 3];
            for (var i = 0; i < 5; i++) RunFrame(world, buffer);
            var before = GC.GetAllocatedBytesForCurrentThread();
            for (var i = 0; i < 20; i++) RunFrame(world, buffer);
            Expect.Equal(0L, GC.GetAllocatedBytesForCurrentThread() - before, "bytes of garbage in 20 frames");
            GC.KeepAlive(new object());
            Expect.True(GC.GetAllocatedBytesForCurrentThread() > before, "the counter counts");
        }
    }

    static void RunFrame(World world, float[] buffer)
    {
        world.Step(Scenes.Frame);
        var sum = world.Stats.MsTotal;
        FloatView positions = world.Positions, velocities = world.Velocities;
        var particles = world.Particles;
        for (var i = 0; i < positions.Count; i++)
            sum += positions.Vector(i).X + velocities[i, 1] + particles[i].Index + world.Materials[i];
        positions.CopyTo(buffer);
        foreach (var happened in world.Events) sum += happened.Count;
        Expect.True(!float.IsNaN(sum), "all is finite");
    }

#if PBMPM_SPANS
    [Test]
    static void SpansShowTheSame()
    {
        using (var world = Scenes.Pool(2))
        {
            FloatView positions = world.Positions, velocities = world.Velocities;
            var packed = positions.Packed;
            Expect.Equal(2 * positions.Count, packed.Length, "length of the positions");
            Expect.Equal(positions[3, 1], packed[7], "a position");
            var second = velocities.Component(1);
            Expect.Equal(velocities.Count, second.Length, "length of a component");
            Expect.Equal(velocities[3, 1], second[3], "a velocity");
            Expect.Throws<InvalidOperationException>(() => velocities.Packed.ToString(), "velocities side by side");
            Expect.Throws<InvalidOperationException>(() => positions.Component(0).ToString(), "one coordinate of all");
            world.Step(Scenes.Frame);
            Expect.Throws<ExpiredViewException>(() => positions.Packed.ToString(), "a span of an expired view");
        }
    }
#endif

    [Test]
    static void ParticlesAreCopiedForRendering()
    {
        using (var world = Scenes.Pool(2))
        {
            var buffer = new float[world.ParticleCount * 5];
            world.Step(Scenes.Frame);
            Expect.Equal(world.ParticleCount, world.CopyParticles(buffer), "particles");
            Expect.Equal(world.Positions[0, 1], buffer[1], "position");
            Expect.Equal(world.Velocities[0, 1], buffer[3], "velocity");
            world.CopyParticles(buffer, 0.5f);
            Expect.Near(world.Positions[0, 1] - 0.5f * Scenes.Frame * world.Velocities[0, 1], buffer[1], 1e-6, "half a step ago");
            Expect.Refused(Result.ErrorCapacity, () => world.CopyParticles(new float[3]), "a buffer that is too small");
            var records = new ParticleRecord[world.ParticleCount];
            Expect.Equal(records.Length, world.CopyParticles(records), "records");
            Expect.Equal(world.Positions[7, 1], records[7].Position.Y, "position of a record");
            Expect.Equal(0f, records[7].Position.Z, "a third coordinate in 2D");
            Expect.Equal(world.Velocities[7, 0], records[7].Velocity.X, "velocity of a record");
            Expect.Equal(world.Materials[7], records[7].Material, "material of a record");
        }
    }
}
