using Pbmpm.Components;
using UnityEngine;

/// <summary>A tap fills a glass with ice cubes. Put it on an empty object of an empty scene, and play.</summary>
public sealed class PourADrink : MonoBehaviour
{
    const float Inner = 0.1f, Wall = 0.02f, Height = 0.24f; // of the glass [m]
    const int Sides = 32;

    [Tooltip("Litres that the tap gives per second.")]
    public float litres = 1;

    void Awake()
    {
        var world = AddWorld();
        AddGlass();
        AddTap();
        for (var i = 0; i < 3; i++) AddIce(new Vector3(0.045f * Mathf.Cos(i * 2.1f), 0.06f + 0.055f * i, 0.045f * Mathf.Sin(i * 2.1f)));
        if (Camera.main != null) Camera.main.transform.position = world.transform.position + new Vector3(0, 0.2f, -0.7f);
    }

    PbmpmWorld AddWorld()
    {
        var body = new GameObject("world");
        body.SetActive(false);
        body.transform.SetParent(transform);
        body.transform.position = new Vector3(0, 0.2f, 0);
        var world = body.AddComponent<PbmpmWorld>();
        world.size = new Vector3(0.4f, 0.4f, 0.4f);
        world.cellSize = 0.0125f;
        world.iterations = 10;
        world.rate = 120; // the smaller the cells, the more steps gravity needs
        world.capacity = 30000;
        world.pace = Pace.FixedUpdate;
        body.AddComponent<PbmpmSurface>();
        body.AddComponent<PbmpmHud>();
        body.SetActive(true);
        return world;
    }

    void AddGlass()
    {
        var mesh = GlassMesh();
        var solid = ScriptableObject.CreateInstance<PbmpmSolid>();
        solid.mesh = mesh;
        solid.resolution = 48;
        solid.Bake();
        var glass = new GameObject("glass");
        glass.transform.SetParent(transform);
        glass.AddComponent<MeshCollider>().sharedMesh = mesh;
        var obstacle = glass.AddComponent<PbmpmCollider>();
        obstacle.shape.form = Form.Solid;
        obstacle.shape.solid = solid;
        obstacle.moves = false;
    }

    void AddTap()
    {
        var tap = new GameObject("tap").AddComponent<PbmpmEmitter>();
        tap.transform.SetParent(transform);
        tap.transform.position = new Vector3(0, 0.35f, 0);
        tap.material = ScriptableObject.CreateInstance<PbmpmLiquid>();
        tap.material.color = new Color(0.2f, 0.5f, 0.9f);
        tap.shape.radius = 0.025f;
        tap.flow = litres / 1000;
        tap.speed = tap.flow / (Mathf.PI * tap.shape.radius * tap.shape.radius);
        tap.budget = 18000;
    }

    void AddIce(Vector3 place)
    {
        const float edge = 0.05f;
        var ice = new GameObject("ice");
        ice.transform.SetParent(transform);
        ice.transform.position = place;
        ice.AddComponent<BoxCollider>().size = Vector3.one * edge;
        ice.AddComponent<PbmpmRigidbody>();
        ice.GetComponent<Rigidbody>().mass = 917 * edge * edge * edge;
        ice.GetComponent<PbmpmCollider>().shape.SetBox(Vector3.zero, Vector3.one * edge);
    }

    /// <summary>A profile turned about the y axis: up outside, over the rim, down inside, and closed at both ends of the axis.</summary>
    static Mesh GlassMesh()
    {
        var profile = new[] { new Vector3(Inner + Wall, 0, 0), new Vector3(Inner + Wall, Height, 0), new Vector3(Inner, Height, 0), new Vector3(Inner, Wall, 0) };
        var corners = new Vector3[profile.Length * Sides + 2];
        for (var i = 0; i < profile.Length * Sides; i++)
        {
            var angle = 2 * Mathf.PI * (i % Sides) / Sides;
            var point = profile[i / Sides];
            corners[i] = new Vector3(point.x * Mathf.Cos(angle), point.y, point.x * Mathf.Sin(angle));
        }
        int bottom = corners.Length - 2, floor = corners.Length - 1, last = (profile.Length - 1) * Sides;
        corners[bottom] = Vector3.zero;
        corners[floor] = new Vector3(0, Wall, 0);
        var triangles = new int[(profile.Length - 1) * Sides * 6 + Sides * 6];
        var next = 0;
        for (var i = 0; i < Sides; i++)
        {
            var j = (i + 1) % Sides;
            for (var ring = 0; ring < last; ring += Sides)
            {
                Put(triangles, ref next, ring + i, ring + Sides + i, ring + j);
                Put(triangles, ref next, ring + j, ring + Sides + i, ring + Sides + j);
            }
            Put(triangles, ref next, bottom, i, j);
            Put(triangles, ref next, floor, last + j, last + i);
        }
        return new Mesh { vertices = corners, triangles = triangles };
    }

    static void Put(int[] triangles, ref int next, int a, int b, int c)
    {
        triangles[next++] = a;
        triangles[next++] = b;
        triangles[next++] = c;
    }
}
