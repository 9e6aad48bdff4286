using System;
using System.Runtime.CompilerServices;
using Pbmpm;

/// <summary>Life of worlds, settings, obstacles, refusals.</summary>
static class WorldTests
{
    [Test]
    static unsafe void DefaultsComeFromTheLibrary()
    {
        Expect.Equal((uint)sizeof(WorldDef), WorldDef.Default.Size, "size");
        Expect.Equal(3, WorldDef.Default.Dimension, "dimension");
        Expect.Equal(1000f, MaterialDef.Default.Density, "density");
        Expect.Equal(1f, Shape.Default.Rotation.W, "rotation");
        Expect.Equal(2f, FillDef.Default.ParticlesPerAxis, "particles per axis");
    }

    [Test]
    static void AllMaterialsAreBuilt()
    {
        foreach (MaterialKind kind in Enum.GetValues(typeof(MaterialKind)))
            Expect.True(Library.Builds(kind), kind.ToString());
        Expect.True(!Library.Builds((MaterialKind)(-1)), "a negative kind");
    }

    [Test]
    static void DefinitionAndSettingsComeBack()
    {
        using (var world = Scenes.Box(2, capacity: 123))
        {
            Expect.Equal(2, world.Dimension, "dimension");
            Expect.Equal(123u, world.Definition.ParticleCapacity, "capacity");
            var settings = world.Settings;
            settings.Substeps = 3;
            world.Settings = settings;
            Expect.Equal(3, world.Settings.Substeps, "substeps");
            Expect.Equal(-10f, world.Settings.Gravity.Y, "gravity");
        }
    }

    [Test]
    static void ARefusalCarriesResultAndMessage()
    {
        var definition = WorldDef.Default;
        definition.CellSize = float.NaN;
        var problem = Expect.Throws<PbmpmException>(() => new World(definition), "a cell size of NaN");
        Expect.Equal(Result.ErrorInvalidArgument, problem.Result, "result");
        Expect.True(problem.Message.StartsWith("PBMPM_ERROR_INVALID_ARGUMENT: "), "the message names the result");
        Expect.True(problem.Message.Contains("cell_size"), "the message names the field: " + problem.Message);
    }

    [Test]
    static void AStepMovesMatterAndCounts()
    {
        using (var world = Scenes.Pool(3))
        {
            world.Step(Scenes.Frame);
            world.Step(Scenes.Frame);
            var stats = world.Stats;
            Expect.Equal(2ul, stats.StepCount, "steps");
            Expect.Equal((uint)world.ParticleCount, stats.ParticleCount, "particles");
            Expect.True(stats.MaxSpeed > 0, "something moves");
            Expect.True(stats.Momentum.Y < 0, "it falls along the second axis");
            Expect.Refused(Result.ErrorInvalidArgument, () => world.Step(0), "a step of no time");
        }
    }

    [Test]
    static void EqualScenesHaveEqualHashesForAnyNumberOfThreads()
    {
        ulong first = HashAfter(10, threads: 1);
        Expect.Equal(first, HashAfter(10, threads: 2), "hash with two threads");
        Expect.True(first != HashAfter(11, threads: 1), "another state has another hash");
    }

    static ulong HashAfter(int steps, int threads)
    {
        using (var world = Scenes.Pool(3, threads))
        {
            for (var i = 0; i < steps; i++) world.Step(Scenes.Frame);
            return world.StateHash;
        }
    }

    [Test]
    static void MaterialsCanBeReadChangedAndRemoved()
    {
        using (var world = Scenes.Box(2))
        {
            var material = world.AddMaterial(MaterialDef.Default);
            var definition = world.GetMaterial(material);
            definition.Viscosity = 0.5f;
            world.SetMaterial(material, definition);
            Expect.Equal(0.5f, world.GetMaterial(material).Viscosity, "viscosity");
            var settings = world.Settings;
            settings.Solver = Solver.Explicit;
            world.Settings = settings;
            definition.BulkModulus = 4e5f;
            world.SetMaterial(material, definition);
            Expect.Equal(4e5f, world.EffectiveModulus(material, 0.001f).BulkModulus, "bulk modulus");
            world.RemoveMaterial(material);
            Expect.Refused(Result.ErrorInvalidId, () => world.RemoveMaterial(material), "a second removal");
        }
    }

    [Test]
    static void ObstaclesCanBeMovedAskedAndRemoved()
    {
        using (var world = Scenes.Pool(2))
        {
            var definition = ColliderDef.Default;
            definition.Kinematic = 1;
            var collider = world.AddCollider(definition, Shape.Sphere(new Float3(1, 1, 0), 0.1f));
            Expect.True(world.Query(collider, new ParticleId[0]) > 0, "the ball stands in the water");
            world.TeleportCollider(collider, new Float3(0.5f, 1, 0));
            Expect.Equal(0.5f, world.ShapeOf(collider).Position.X, "place after a teleport");
            Expect.Equal(0, world.Query(collider, new ParticleId[0]), "particles inside the ball beside the water");
            var quarter = new Float4(0, 0, (float)Math.Sqrt(0.5), (float)Math.Sqrt(0.5));
            world.MoveCollider(collider, new Float3(0.6f, 1, 0), quarter);
            world.Step(Scenes.Frame);
            Expect.Near(0.6, world.ShapeOf(collider).Position.X, 1e-6, "place after a move and a step");
            Expect.Near(quarter.Z, world.ShapeOf(collider).Rotation.Z, 1e-6, "turn after a move and a step");
            world.MoveCollider(collider, new Float3(0.7f, 1, 0));
            world.TeleportCollider(collider, new Float3(0.7f, 1, 0), new Float4(0, 0, 0, 1));
            world.RemoveCollider(collider);
            Expect.Refused(Result.ErrorInvalidId, () => world.GetCollider(collider), "an obstacle that was removed");
        }
    }

    [Test]
    static void EveryShapeIsUnderstood()
    {
        using (var world = Scenes.Box(3))
        {
            var definition = ColliderDef.Default;
            var shapes = new[]
            {
                Shape.Plane(new Float3(0, 0, 0), new Float3(0, 1, 0)),
                Shape.Box(new Float3(1, 1, 1), new Float3(0.1f, 0.2f, 0.3f)),
                Shape.Sphere(new Float3(1, 1, 1), 0.2f),
                Shape.Capsule(new Float3(1, 1, 1), 0.3f, 0.1f),
            };
            foreach (var shape in shapes)
            {
                var found = world.ShapeOf(world.AddCollider(definition, shape));
                Expect.Equal(shape.Kind, found.Kind, "kind");
                Expect.Equal(shape.HalfExtents.X, found.HalfExtents.X, "half extent");
                Expect.Equal(shape.Radius, found.Radius, "radius");
            }
        }
    }

    [Test]
    static void MatterThatFindsNoRoomIsAnEvent()
    {
        using (var world = Scenes.Box(2, capacity: 10))
        {
            var fill = Scenes.Water(world);
            Expect.Refused(Result.ErrorCapacity, () => world.Fill(fill, Scenes.Block), "filling beyond the capacity");
            Expect.Equal(0, world.ParticleCount, "particles");
            var seen = 0;
            foreach (var happened in world.Events)
            {
                Expect.Equal(EventKind.Capacity, happened.Kind, "kind");
                Expect.True(happened.Count > 10, "the event says how many are needed");
                seen++;
            }
            Expect.Equal(1, seen, "number of events");
            var events = world.Events;
            Expect.Equal(0u, events.Missed, "missed events");
            world.Step(Scenes.Frame);
            Expect.Throws<ExpiredViewException>(() => events[0].ToString(), "an event of before the step");
        }
    }

    [Test]
    static void ADisposedWorldIsRefused()
    {
        var world = Scenes.Pool(2);
        var positions = world.Positions;
        world.Dispose();
        world.Dispose();
        world.Close();
        Expect.True(world.IsDisposed, "it is disposed of");
        Expect.Throws<ObjectDisposedException>(() => world.Step(Scenes.Frame), "a step");
        Expect.Throws<ObjectDisposedException>(() => world.Positions.ToString(), "a view");
        Expect.Throws<ExpiredViewException>(() => positions[0, 0].ToString(), "an old view");
    }

    [Test]
    static void ForgottenWorldsAreDestroyed()
    {
        for (var round = 0; round < 5; round++)
        {
            Forget(Constants.MaxWorlds / 4);
            GC.Collect();
            GC.WaitForPendingFinalizers();
        }
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    static void Forget(int count)
    {
        for (var i = 0; i < count; i++) Scenes.Box(2, capacity: 1);
    }

    [Test]
    static void AShutDownLibraryGoesOn()
    {
        var world = Scenes.Pool(2);
        Library.Shutdown();
        Expect.Refused(Result.ErrorInvalidId, () => world.Step(Scenes.Frame), "a world of before");
        world.Dispose();
        Scenes.Pool(2).Dispose();
    }
}
