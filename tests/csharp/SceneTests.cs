using System;
using Pbmpm;
using Pbmpm.Native;

/// <summary>What is in a world, the box that it is in, numbers of the host's, and lines.</summary>
static class SceneTests
{
    static void Run(World world, int steps)
    {
        for (var i = 0; i < steps; i++) world.Step(Scenes.Frame);
    }

    [Test]
    static void ListsHoldWhatIsThere()
    {
        using (var world = Scenes.Pool(2))
        {
            var ball = Shape.Sphere(new Float3(1, 1, 0), 0.1f);
            var first = world.AddCollider(ColliderDef.Default, ball);
            var second = world.AddCollider(ColliderDef.Default, ball);
            var drain = world.AddDrain(DrainDef.Default, ball);
            Expect.Equal(2, world.GetColliders().Length, "colliders");
            Expect.Equal(1, world.GetMaterials().Length, "materials");
            Expect.Equal(0, world.GetEmitters().Length, "emitters");
            Expect.Equal(drain.Generation, world.GetDrains()[0].Generation, "the drain");
            Expect.Equal(0, world.GetForces().Length, "forces");
            world.RemoveCollider(first);
            Expect.True(!world.IsValid(first) && world.IsValid(second), "who is there");
            Expect.Equal(second.Generation, world.GetColliders()[0].Generation, "who is left");
        }
    }

    [Test]
    static void ACollidersShapeAndDefinitionChange()
    {
        using (var world = Scenes.Pool(2))
        {
            var collider = world.AddCollider(ColliderDef.Default, Shape.Sphere(new Float3(1, 1, 0), 0.1f));
            world.SetCollider(collider, Shape.Box(new Float3(1, 1.5f, 0), new Float3(0.2f, 0.1f, 0.1f)));
            Expect.Equal(1.5f, world.ShapeOf(collider).Position.Y, "the new place");
            var definition = world.GetCollider(collider);
            definition.Friction = Friction.Stick;
            world.SetCollider(collider, definition);
            Expect.Equal(Friction.Stick, world.GetCollider(collider).Friction, "the new friction");
            Expect.Equal(ShapeKind.Box, world.ShapeOf(collider).Kind, "the shape stays");
        }
    }

    [Test]
    static void AWallOpens()
    {
        using (var world = Scenes.Pool(2))
        {
            var wall = world.GetWall(0, true);
            Expect.Equal(0, wall.Open, "walls are closed");
            wall.Open = 1;
            world.SetWall(0, true, wall);
            Expect.Equal(1, world.GetWall(0, true).Open, "it is open");
            Run(world, 90);
            var farthest = 0f;
            var positions = world.Positions;
            for (var i = 0; i < positions.Count; i++) farthest = System.Math.Max(farthest, positions[i, 0]);
            Expect.True(farthest > world.Definition.DomainMax.X + 0.1f, "water got out");
            Expect.Refused(Result.ErrorInvalidArgument, () => world.GetWall(2, false), "no third axis");
        }
    }

    [Test]
    static void TheOriginMoves()
    {
        using (var world = Scenes.Pool(2))
        {
            var before = world.Positions[0, 0];
            var moved = world.ShiftOrigin(new Double3(100, 0, 0));
            Expect.True(System.Math.Abs(moved.X - 100) < 1, "by whole blocks");
            Expect.True(System.Math.Abs(world.Positions[0, 0] + moved.X - before) < 1e-4, "positions are less by it");
            Expect.Equal(moved.X, world.Definition.Origin.X, "the origin");
        }
    }

    [Test]
    static void UserValuesGoWithTheParticles()
    {
        using (var world = Scenes.Pool(2))
        {
            Expect.Refused(Result.ErrorUnsupported, () => { var none = world.UserValues; }, "none was given");
            var id = world.Particles[3];
            world.SetUserValues(new[] { id }, new[] { 77u });
            Run(world, 10);
            var row = new uint[1];
            world.Find(new[] { id }, row);
            Expect.Equal(77u, world.UserValues[(int)row[0]], "its number");
            var all = new uint[world.ParticleCount];
            for (var i = 0; i < all.Length; i++) all[i] = (uint)i;
            world.SetUserValues(all);
            Expect.Equal(5u, world.UserValues[5], "all numbers");
        }
    }

    [Test]
    static void ASensorSeesWater()
    {
        using (var world = Scenes.Pool(2))
        {
            var definition = ColliderDef.Default;
            definition.Sensor = definition.ReportsTouches = 1;
            var sensor = world.AddCollider(definition, Shape.Sphere(new Float3(1, 1, 0), 0.1f));
            var touches = new Touch[4];
            Expect.Equal(1, world.Touches(touches), "touches");
            Expect.Equal(TouchState.Began, touches[0].State, "it is new");
            Expect.Equal(sensor.Generation, touches[0].Collider.Generation, "whose");
            Expect.True(touches[0].Particles > 4, "particles");
            world.Touches(touches);
            Expect.Equal(TouchState.Stays, touches[0].State, "it was there before");
        }
    }

    [Test]
    static void LinesShowWhatIsThere()
    {
        using (var world = Scenes.Pool(2))
        {
            world.AddCollider(ColliderDef.Default, Shape.Box(new Float3(1, 1.5f, 0), new Float3(0.2f, 0.1f, 0.1f)));
            Expect.Equal(4, world.CountDebugLines(DebugPart.Colliders), "sides");
            var lines = new Line[8];
            Expect.Equal(8, world.DebugLines(lines, DebugPart.Colliders | DebugPart.Domain), "lines");
            Expect.Equal(DebugPart.Domain, lines[0].Part, "the domain comes first");
            Expect.Equal(DebugPart.Colliders, lines[7].Part, "then obstacles");
        }
    }

    [Test]
    static void ASurfaceIsClosedAndFits()
    {
        using (var world = Scenes.Pool(3))
        {
            var counts = world.CountSurface(SurfaceDef.Default);
            Expect.True(counts.Vertices > 100, "vertices");
            Expect.Equal(6 * counts.Vertices - 12, counts.Indices, "as many indices as a ball has");
            var few = new Float3[10];
            Expect.True(!world.TryMakeSurface(few, null, new uint[counts.Indices], out counts), "there is no room");
            Expect.Equal(0f, few[0].X, "nothing was written");
            Float3[] positions = new Float3[counts.Vertices], normals = new Float3[counts.Vertices];
            var indices = new uint[counts.Indices];
            Expect.True(world.TryMakeSurface(positions, normals, indices, out counts), "there is room");
            for (var i = 0; i < positions.Length; i++)
            {
                Expect.Near(1, positions[i].Y, 0.25, "around the block");
                double along = (positions[i].X - 1) * normals[i].X + (positions[i].Y - 1) * normals[i].Y + (positions[i].Z - 1) * normals[i].Z;
                Expect.True(along > 0, "normals point outwards");
            }
            foreach (var index in indices) Expect.True(index < positions.Length, "indices are of vertices");
        }
    }

    [Test]
    static unsafe void PointsHaveColours()
    {
        using (var world = Scenes.Pool(3))
        {
            var points = new Point[world.ParticleCount];
            Expect.Equal(points.Length, world.CopyPoints(points), "all particles");
            Expect.Equal(0xffffffff, points[0].Colour, "white");
            var material = world.GetMaterials()[0];
            var colour = 0x80402010;
            var definition = PointsDef.Default;
            definition.Materials = (IntPtr)(&material);
            definition.MaterialCount = 1;
            definition.Palette = &colour;
            Expect.Equal(points.Length, world.CopyPoints(definition, points), "all of one material");
            Expect.Equal(colour, points[7].Colour, "its colour");
            Expect.Near(0.031, points[7].Radius, 0.001, "of a ball of an eighth of a cell");
        }
    }
}
