using Pbmpm;
using Pbmpm.Components;
using UnityEngine;

/// <summary>One scene twice: of components, and by calls of the C# binding alone. Their states have to be equal, bit for bit.</summary>
static class Scene
{
    public const float Frame = 1 / 60f;
    static readonly Vector3 Box = new Vector3(2, 2, 1);
    static readonly Vector3 Tap = new Vector3(-0.6f, 0.7f, 0), Plug = new Vector3(0.9f, -0.9f, 0), Jelly = new Vector3(0.2f, 0.6f, 0);
    static readonly Vector3 Pool = new Vector3(0, -0.75f, 0), Paddle = new Vector3(0, -0.6f, 0);

    /// <summary>Where the paddle shall be after a frame.</summary>
    static Vector3 PaddleAt(int frame)
    {
        return Paddle + new Vector3(0.3f * Mathf.Sin(frame * 0.05f), 0, 0);
    }

    /// <summary>The scene of components, with both renderers, a camera and the HUD.</summary>
    public sealed class OfComponents
    {
        readonly PbmpmCollider paddle;
        public readonly PbmpmWorld World;

        public OfComponents(bool background)
        {
            var water = ScriptableObject.CreateInstance<PbmpmLiquid>();
            var jelly = ScriptableObject.CreateInstance<PbmpmElastic>();
            var body = new GameObject("world");
            body.SetActive(false);
            World = body.AddComponent<PbmpmWorld>();
            World.size = Box;
            World.cellSize = 0.125f;
            World.capacity = 8192;
            World.threads = 1;
            World.background = background;
            body.AddComponent<PbmpmPoints>();
            body.AddComponent<PbmpmSurface>();
            body.AddComponent<PbmpmHud>();
            new GameObject("camera").AddComponent<Camera>();

            paddle = Add<PbmpmCollider>(PaddleAt(0));
            paddle.shape.SetBox(Vector3.zero, new Vector3(0.125f, 0.5f, 0.6f));
            var tap = Add<PbmpmEmitter>(Tap);
            tap.material = water;
            tap.shape.radius = 0.1f;
            var drain = Add<PbmpmDrain>(Plug);
            drain.shape.SetSphere(Vector3.zero, 0.2f);
            AddFill(Pool, new Vector3(2, 0.5f, 1), water);
            AddFill(Jelly, new Vector3(0.5f, 0.5f, 0.5f), jelly);
            body.SetActive(true);
        }

        public void Advance(int frame)
        {
            paddle.transform.position = PaddleAt(frame);
            Player.Frame(Frame);
        }

        static void AddFill(Vector3 place, Vector3 edges, PbmpmMaterial material)
        {
            var fill = Add<PbmpmFill>(place);
            fill.material = material;
            fill.shape.SetBox(Vector3.zero, edges);
        }

        static T Add<T>(Vector3 place) where T : Component
        {
            var made = new GameObject();
            made.transform.position = place;
            return made.AddComponent<T>();
        }
    }

    /// <summary>The hash after some frames, by the C# binding.</summary>
    public static ulong HashOfCalls(int frames)
    {
        var definition = WorldDef.Default;
        definition.CellSize = 0.125f;
        definition.ParticleCapacity = 8192;
        definition.ThreadCount = 1;
        definition.DomainEnabled = 1;
        definition.DomainMin = Box * -0.5f;
        definition.DomainMax = Box * 0.5f;
        using (var world = new World(definition))
        {
            var settings = world.Settings;
            settings.Gravity = new Float3(0, -9.81f, 0);
            world.Settings = settings;
            var moving = ColliderDef.Default;
            moving.Kinematic = 1;
            var paddle = world.AddCollider(moving, Shape.Box(PaddleAt(0), new Float3(0.0625f, 0.25f, 0.3f)));
            var water = world.AddMaterial(MaterialDef.Default);
            var jet = EmitterDef.Default;
            jet.Material = water;
            jet.Region = EmitterRegion.Disc;
            jet.Speed = 1;
            jet.Rate = Mathf.PI * 0.1f * 0.1f;
            world.AddEmitter(jet, Shape.Sphere(Tap, 0.1f));
            world.AddDrain(DrainDef.Default, Shape.Sphere(Plug, 0.2f));
            var fill = FillDef.Default;
            fill.Material = water;
            world.Fill(fill, Shape.Box(Pool, new Float3(1, 0.25f, 0.5f)));
            var elastic = MaterialDef.Default;
            elastic.Kind = MaterialKind.Elastic;
            fill.Material = world.AddMaterial(elastic);
            world.Fill(fill, Shape.Box(Jelly, new Float3(0.25f, 0.25f, 0.25f)));
            for (var frame = 0; frame < frames; frame++)
            {
                if (frame > 0) world.MoveCollider(paddle, PaddleAt(frame), new Float4(0, 0, 0, 1));
                world.Step(Frame);
            }
            return world.StateHash;
        }
    }
}
