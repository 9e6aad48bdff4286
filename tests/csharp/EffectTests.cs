using System;
using Pbmpm;

/// <summary>Emitters, drains, forces, baked solids, queries, snapshots and steps in the background.</summary>
static class EffectTests
{
    static void Run(World world, int steps)
    {
        for (var i = 0; i < steps; i++) world.Step(Scenes.Frame);
    }

    [Test]
    static void AdviceTellsWhatASceneWillNotHold()
    {
        using (var world = Scenes.Pool(2))
        {
            Expect.Equal(0, world.Advice(Scenes.Frame).Length, "advice for a pool");
            var settings = world.Settings;
            settings.Gravity = new Float3(0, 0, 0);
            world.Settings = settings;
            var advice = world.Advice(Scenes.Frame);
            Expect.Equal(1, advice.Length, "advice without gravity");
            Expect.Equal(AdviceCode.NoGravity, advice[0].Code, "what it is about");
            Expect.Equal(Change.Gravity, advice[0].Change, "what would help");
            Expect.Equal(9.81f, advice[0].Value, "to what");
            Expect.True(advice[0].ToString().Contains("gravity") && !advice[0].CameTrue, "words");
            Expect.Refused(Result.ErrorInvalidArgument, () => world.Advice(0), "no time step");
        }
    }

    [Test]
    static void WhatIsEmittedDrainedAndKilledAddsUp()
    {
        using (var world = Scenes.Box(2))
        {
            var source = EmitterDef.Default;
            source.Material = world.AddMaterial(MaterialDef.Default);
            source.Rate = 0.6f;
            source.Budget = 60;
            var emitter = world.AddEmitter(source, Shape.Box(new Float3(1, 1.5f, 0), new Float3(0.2f, 0.1f, 0)));
            var drain = world.AddDrain(DrainDef.Default, Shape.Plane(new Float3(0, 0.1f, 0), new Float3(0, 1, 0)));
            world.SetDrain(drain, Shape.Plane(new Float3(0, 0.2f, 0), new Float3(0, 1, 0)));
            Expect.Equal(0.2f, world.ShapeOf(drain).Position.Y, "where the drain was put");
            Run(world, 60);
            var emitted = world.StatusOf(emitter);
            var drained = world.StatusOf(drain);
            Expect.Equal(60ul, emitted.Emitted, "particles within the budget");
            Expect.True(emitted.RefusedBudget > 0, "more were due");
            Expect.True(drained.Drained > 0, "the drain took some");
            Expect.Equal((ulong)world.ParticleCount, emitted.Emitted - drained.Drained, "particles that are left");

            var bounds = KillBounds.Default;
            bounds.Enabled = 1;
            bounds.Low = new Float3(1.9f, 1.9f, 0);
            bounds.High = new Float3(2, 2, 0);
            world.KillBounds = bounds;
            Expect.Equal(1.9f, world.KillBounds.Low.X, "lower corner");
            Run(world, 1);
            Expect.Equal(0, world.ParticleCount, "particles outside of the bounds");
            var flow = world.Flow;
            Expect.Equal(flow.Emitted, flow.Drained + flow.Killed, "all that was emitted");

            source = world.GetEmitter(emitter);
            source.Enabled = 0;
            world.SetEmitter(emitter, source);
            world.MoveEmitter(emitter, new Float3(0.5f, 1.5f, 0));
            world.MoveEmitter(emitter, new Float3(0.5f, 1.5f, 0), new Float4(0, 0, 0, 1));
            var sink = world.GetDrain(drain);
            sink.Enabled = 0;
            world.SetDrain(drain, sink);
            Expect.Equal(0, world.GetDrain(drain).Enabled, "a drain that was switched off");
            world.RemoveDrain(drain);
            world.RemoveEmitter(emitter);
            Expect.Refused(Result.ErrorInvalidId, () => world.StatusOf(drain), "a drain that was removed");
            Expect.Refused(Result.ErrorInvalidId, () => world.GetEmitter(emitter), "an emitter that was removed");
        }
    }

    [Test]
    static void AForceGivesItsImpulse()
    {
        using (var world = Scenes.Pool(2))
        {
            var wind = ForceDef.Default;
            wind.Direction = new Float3(1, 0, 0);
            wind.Strength = 3;
            var force = world.AddForce(wind, Shape.Default);
            var mass = world.Stats.Mass;
            Run(world, 1);
            Expect.Near(mass * 3 * Scenes.Frame, world.StatusOf(force).Impulse.X, 1e-4 * mass, "impulse");
            Expect.Near(mass * 3 * Scenes.Frame, world.Stats.Momentum.X, 1e-4 * mass, "momentum");
            wind = world.GetForce(force);
            wind.Enabled = 0;
            world.SetForce(force, wind);
            Run(world, 1);
            Expect.Equal(0u, world.StatusOf(force).Nodes, "nodes that feel it when it is off");
            world.RemoveForce(force);
            Expect.Refused(Result.ErrorInvalidId, () => world.GetForce(force), "a force that was removed");
        }
    }

    static readonly float[] Square = { -0.3f, -0.3f, 0.3f, -0.3f, 0.3f, 0.3f, -0.3f, 0.3f };
    static readonly uint[] Edges = { 0, 1, 1, 2, 2, 3, 3, 0 };

    [Test]
    static void BakedSolidsAreKeptLoadedAndPressedOn()
    {
        var solid = BakedSolid.FromMesh(2, Square, Edges);
        Expect.Equal(2, solid.Info.Dimension, "dimension");
        Expect.Equal(solid.Data.Length, new BakedSolid(solid.Data).Data.Length, "bytes of a copy");
        Expect.Equal(2, BakedSolid.FromHull(2, Square).Info.Dimension, "dimension of a hull");
        Expect.Refused(Result.ErrorInvalidArgument, () => BakedSolid.FromMesh(2, Square, new uint[] { 0, 1, 1, 2 }), "an open mesh");
        var spoilt = (byte[])solid.Data.Clone();
        spoilt[spoilt.Length / 2] ^= 1;
        Expect.Refused(Result.ErrorDamaged, () => new BakedSolid(spoilt), "a damaged solid");

        using (var world = Scenes.Box(2))
        {
            var loaded = world.Load(solid);
            var definition = ColliderDef.Default;
            definition.MeasuresImpulse = 1;
            var collider = world.AddCollider(definition, Shape.Solid(new Float3(1, 0.5f, 0), loaded));
            Expect.Refused(Result.ErrorInUse, () => world.Unload(loaded), "a solid that an obstacle has");
            var fill = Scenes.Water(world);
            world.Fill(fill, Shape.Box(new Float3(1, 1, 0), new Float3(0.3f, 0.2f, 0)));
            Run(world, 3);
            Expect.True(world.ImpulseOn(collider).Linear.Y < 0, "water presses down");
            world.RemoveCollider(collider);
            world.Unload(loaded);
            Expect.Refused(Result.ErrorInvalidArgument, () => world.ImpulseOnWall(0, true), "a wall that measures nothing");
        }
    }

    [Test]
    static void ARigidBodyHangsOnAHinge()
    {
        using (var world = Scenes.Box(2))
        {
            var shape = Shape.Box(new Float3(1, 1, 0), new Float3(0.2f, 0.1f, 0));
            var definition = ColliderDef.Default;
            definition.MeasuresImpulse = definition.Kinematic = 1;
            var collider = world.AddCollider(definition, shape);
            var rigid = RigidBody.Of(world.MassOf(shape, 500));
            Expect.Near(500 * 0.08, rigid.Mass, 1e-4, "mass");
            rigid.Moves = Freedom.None;
            rigid.Pivot.X = 0.2;
            var body = new RigidBody(world, collider, rigid);
            body.Definition.Torque.Z = 3;
            for (var step = 0; step < 10; step++)
            {
                body.Advance(Scenes.Frame);
                Run(world, 1);
            }
            Expect.True(body.State.AngularVelocity.Z > 0, "it turns");
            var x = body.State.Position.X - 1.2;
            var y = body.State.Position.Y - 1;
            Expect.Near(0.2, Math.Sqrt(x * x + y * y), 1e-5, "distance from the hinge");
            Expect.Near(0, world.SubmersionOf(collider).Share, 0, "share under");
        }
    }

    [Test]
    static void TerrainIsBakedFromHeights()
    {
        var count = new Uint2 { X = 3 };
        var spacing = new Float2 { X = 0.5f };
        var solid = BakedSolid.FromHeights(2, new[] { 0f, 0.5f, 0f }, count, spacing);
        var grid = solid.Info;
        Expect.Near(-1 - 2 * grid.Spacing, grid.Minimum.Y, 1e-5, "its base is two grid cells inside");
        Expect.Throws<ArgumentException>(() => BakedSolid.FromHeights(2, new float[2], count, spacing), "too few heights");
    }

    [Test]
    static void QueriesFindTheWater()
    {
        using (var world = Scenes.Pool(2))
        {
            var shares = new RegionShare[2];
            Expect.Equal(1, world.QueryRegion(Shape.Box(new Float3(1, 1, 0), new Float3(1, 1, 0)), shares), "materials");
            Expect.Near(0.16, shares[0].RestVolume, 1e-5, "area of the block");

            var points = new[] { 1f, 1f, 0.2f, 0.2f };
            float[] filling = new float[2], density = new float[2], velocity = new float[4], heights = new float[2];
            world.QueryPoints(points, filling, density, velocity);
            Expect.Near(1, filling[0], 0.02, "filling inside");
            Expect.Near(1000, density[0], 20, "density inside");
            Expect.Equal(0f, filling[1], "filling outside");
            world.QueryHeights(points, heights);
            Expect.Near(1.2, heights[0], 0.03, "height of the surface");
            Expect.True(float.IsNegativeInfinity(heights[1]), "no surface where there is no water");
            world.QueryHeights(points, heights, 0.5f, new Float3(1, 0, 0));
            Expect.Near(1.2, heights[0], 0.03, "the surface to the right");

            var ray = Ray.Default;
            ray.Origin = new Float3(1, 2, 0);
            var hit = world.Cast(ray);
            Expect.Equal(1, hit.Hit, "hits");
            Expect.Near(0.8, hit.Distance, 0.03, "distance");
            Expect.Throws<ArgumentException>(() => world.QueryPoints(points, new float[1]), "room for too few points");
        }
    }

    [Test]
    static void ARestoredSnapshotGoesOnTheSame()
    {
        using (var world = Scenes.Pool(2))
        {
            Run(world, 3);
            var buffer = new byte[world.SnapshotSize];
            Expect.Equal((long)buffer.Length, world.SaveTo(buffer), "bytes");
            Run(world, 5);
            var hash = world.StateHash;
            var positions = world.Positions;
            world.Restore(buffer);
            Expect.True(!positions.IsCurrent, "views have expired");
            Run(world, 5);
            Expect.Equal(hash, world.StateHash, "hash");
            buffer[buffer.Length / 2] ^= 1;
            Expect.Refused(Result.ErrorDamaged, () => world.Restore(buffer), "a damaged snapshot");
            Expect.Equal(hash, world.StateHash, "hash after a refusal");
            Expect.Refused(Result.ErrorCapacity, () => world.SaveTo(new byte[8]), "room for 8 bytes");
        }
    }

    [Test]
    static void AStepInTheBackgroundIsTheSameStep()
    {
        using (World world = Scenes.Pool(2), other = Scenes.Pool(2))
        {
            Run(other, 2);
            world.Publish(Field.Position);
            world.BeginStep(Scenes.Frame);
            Expect.Near(0.8, Lowest(world.Positions), 0.051, "the state before, while it runs");
            Expect.Refused(Result.ErrorBusy, () => world.Step(Scenes.Frame), "a step meanwhile");
            world.EndStep();
            world.BeginStep(Scenes.Frame);
            while (!world.IsStepDone) System.Threading.Thread.Yield();
            Expect.Equal(true, world.TryEndStep(), "the end of a step that is done");
            world.BeginStep(Scenes.Frame);
            Run(other, 1);
            while (!world.TryEndStep()) System.Threading.Thread.Yield();
            Expect.Equal(other.StateHash, world.StateHash, "hash");
            Expect.Refused(Result.ErrorInvalidArgument, () => world.EndStep(), "the end of no step");
        }
    }

    [Test]
    static void APublishedFrameStaysUntilTheNextBeginButOne()
    {
        using (var world = Scenes.Pool(2))
        {
            Run(world, 3);
            world.BeginStep(Scenes.Frame);
            var frame = world.Positions;
            var shown = new float[frame.Count * frame.Components];
            frame.CopyTo(shown);
            world.EndStep();
            world.RemoveIn(Shape.Box(new Float3(1, 1, 1), new Float3(0.1f, 0.1f, 0.1f)));
            world.BeginStep(Scenes.Frame);
            world.EndStep();
            Expect.True(frame.IsCurrent, "a frame that is one begin old");
            for (var i = 0; i < shown.Length; i++) Expect.Equal(shown[i], frame[i / 2, i % 2], "a value of it");
            world.BeginStep(Scenes.Frame);
            Expect.True(!frame.IsCurrent, "a frame that is two begins old");
            world.EndStep();
        }
    }

    [Test]
    static void FiguresOfTheStepAlone()
    {
        using (var world = Scenes.Pool(2))
        {
            Run(world, 2);
            Stats all = world.Stats, step = world.StepStats;
            Expect.Equal(all.MsTotal, step.MsTotal, "time");
            Expect.Equal(all.ParticleCount, step.ParticleCount, "particles");
            Expect.True(all.Mass > 0 && step.Mass == 0, "what takes a pass is left out");
            world.BeginStep(Scenes.Frame);
            Expect.Equal(2ul, world.StepStats.StepCount, "steps, while the third runs");
            world.EndStep();
            Expect.Equal(3ul, world.StepStats.StepCount, "steps");
        }
    }

    [Test]
    static void WhatRestsSleepsUntilItIsWoken()
    {
        using (var world = Scenes.Pool(2))
        {
            var settings = world.Settings;
            settings.Gravity = new Float3(0, 0, 0);
            settings.Sleeping = 1;
            settings.SleepTime = 0.1f;
            world.Settings = settings;
            Run(world, 20);
            Expect.Equal((uint)world.ParticleCount, world.Stats.ParticlesAsleep, "particles asleep");
            world.Wake(Shape.Sphere(new Float3(1, 1, 0), 0.1f));
            Run(world, 1);
            Expect.Equal(0u, world.Stats.ParticlesAsleep, "particles asleep after a call");
            Run(world, 20);
            Expect.Equal((uint)world.ParticleCount, world.Stats.ParticlesAsleep, "particles asleep again");
            world.Wake();
            Run(world, 1);
            Expect.Equal(0u, world.Stats.ParticlesAsleep, "particles asleep after the other call");
        }
    }

    static double Lowest(FloatView positions)
    {
        var lowest = double.PositiveInfinity;
        for (var i = 0; i < positions.Count; i++) lowest = Math.Min(lowest, positions[i, 1]);
        return lowest;
    }
}
