using Pbmpm;

/// <summary>Small worlds for the tests.</summary>
static class Scenes
{
    public const float Frame = 1f / 60;

    /// <summary>A closed box of 2 m with cells of 10 cm and gravity along the second axis.</summary>
    public static World Box(int dimension, uint capacity = 5000, int threads = 1)
    {
        var definition = WorldDef.Default;
        definition.Dimension = dimension;
        definition.CellSize = 0.1f;
        definition.ParticleCapacity = capacity;
        definition.ThreadCount = threads;
        definition.DomainEnabled = 1;
        definition.DomainMax = new Float3(2, 2, 2);
        var world = new World(definition);
        var settings = world.Settings;
        settings.Gravity = new Float3(0, -10, 0);
        world.Settings = settings;
        return world;
    }

    /// <summary>The box with a block of water in its middle.</summary>
    public static World Pool(int dimension, int threads = 1)
    {
        var world = Box(dimension, threads: threads);
        Expect.True(world.Fill(Water(world), Block) > 0, "the block has particles");
        return world;
    }

    public static FillDef Water(World world)
    {
        var fill = FillDef.Default;
        fill.Material = world.AddMaterial(MaterialDef.Default);
        return fill;
    }

    public static Shape Block => Shape.Box(new Float3(1, 1, 1), new Float3(0.2f, 0.2f, 0.2f));
}
