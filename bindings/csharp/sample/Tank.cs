// Fills half of a tank with water, lets it run for a second, and prints what the library says about it.
using System;
using System.Globalization;
using Pbmpm;

static class Tank
{
    const int Rate = 60;

    // A closed box of 2 m x 1 m, with cells of 2.5 cm.
    static World MakeTank()
    {
        var definition = WorldDef.Default;
        definition.Dimension = 2;
        definition.CellSize = 0.025f;
        definition.ParticleCapacity = 10000;
        definition.DomainEnabled = 1;
        definition.DomainMax = new Float3(2, 1, 0);
        var world = new World(definition);

        var settings = world.Settings;
        settings.Gravity.Y = -9.81f;
        world.Settings = settings;
        return world;
    }

    // A column of water at the left wall, 1 m wide and 0.8 m high.
    static void AddWater(World world)
    {
        var fill = FillDef.Default;
        fill.Material = world.AddMaterial(MaterialDef.Default);
        world.Fill(fill, Shape.Box(new Float3(0.5f, 0.4f, 0), new Float3(0.5f, 0.4f, 0.5f)));
    }

    static float HighestPoint(World world)
    {
        var positions = world.Positions;
        var highest = 0f;
        for (var particle = 0; particle < positions.Count; particle++)
            highest = Math.Max(highest, positions[particle, 1]);
        return highest;
    }

    static void Print(World world, double milliseconds)
    {
        var stats = world.Stats;
        Console.WriteLine("{0} particles, {1:F2} s simulated in {2:F1} ms with {3} kernels", stats.ParticleCount,
            stats.SimulatedSeconds, milliseconds, Library.NameOf(Library.ActiveIsa));
        Console.WriteLine("volume error {0:F2} % (rms), fastest particle {1:F2} m/s, highest point {2:F2} m",
            100 * stats.VolumeErrorRms, stats.MaxSpeed, HighestPoint(world));
        foreach (var happened in world.Events)
            Console.WriteLine("event in step {0}: {1}, {2} particles", happened.Step, happened.Kind, happened.Count);
        Console.WriteLine("state hash {0:x16}", world.StateHash);
    }

    static int Main()
    {
        CultureInfo.CurrentCulture = CultureInfo.InvariantCulture;
        try
        {
            using (var world = MakeTank())
            {
                AddWater(world);
                var milliseconds = 0.0;
                for (var frame = 0; frame < Rate; frame++)
                {
                    world.Step(1.0f / Rate);
                    milliseconds += world.Stats.MsTotal;
                }
                Print(world, milliseconds);
            }
            return 0;
        }
        catch (Exception problem) when (problem is PbmpmException || problem is LibraryException)
        {
            Console.Error.WriteLine("tank: " + problem.Message);
            return 1;
        }
    }
}
