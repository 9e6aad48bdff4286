using Pbmpm.Components;
using UnityEngine;

/// <summary>A raft drifts down a river to a drain. Put it on an empty object of an empty scene, and play.</summary>
public sealed class RaftOnARiver : MonoBehaviour
{
    const int Samples = 33;
    static readonly Vector3 Land = new Vector3(8, 1.6f, 4); // [m]

    void Awake()
    {
        var world = AddWorld();
        var water = ScriptableObject.CreateInstance<PbmpmLiquid>();
        water.color = new Color(0.2f, 0.5f, 0.8f);
        AddBed();
        AddPond(water);
        AddSpring(water);
        AddDrain();
        AddRaft();
        AddRake();
        if (Camera.main != null) Camera.main.transform.position = world.transform.position + new Vector3(0, 2, -6);
    }

    PbmpmWorld AddWorld()
    {
        var body = new GameObject("world");
        body.SetActive(false);
        body.transform.SetParent(transform);
        var world = body.AddComponent<PbmpmWorld>();
        world.size = new Vector3(7, 3, 3);
        world.cellSize = 0.125f;
        world.capacity = 40000;
        world.pace = Pace.FixedUpdate;
        body.AddComponent<PbmpmSurface>();
        body.AddComponent<PbmpmHud>();
        body.SetActive(true);
        return world;
    }

    /// <summary>A valley that falls along x. It reaches past the walls of the world, as terrain has to.</summary>
    void AddBed()
    {
        var heights = new float[Samples, Samples];
        for (var z = 0; z < Samples; z++)
            for (var x = 0; x < Samples; x++)
            {
                float along = x / (Samples - 1f), across = 2f * z / (Samples - 1) - 1;
                heights[z, x] = 0.35f * (1 - along) + 0.6f * across * across;
            }
        var data = new TerrainData { heightmapResolution = Samples, size = Land };
        data.SetHeights(0, 0, heights);

        var bed = Terrain.CreateTerrainGameObject(data);
        bed.transform.SetParent(transform);
        bed.transform.position = new Vector3(-Land.x / 2, -1.4f, -Land.z / 2);
        var solid = ScriptableObject.CreateInstance<PbmpmSolid>();
        solid.terrain = data;
        solid.resolution = 80;
        solid.thickness = 0.5f;
        solid.Bake();
        var obstacle = bed.AddComponent<PbmpmCollider>();
        obstacle.shape.form = Form.Solid;
        obstacle.shape.solid = solid;
        obstacle.moves = false;
    }

    void AddPond(PbmpmMaterial water)
    {
        var fill = Make<PbmpmFill>("pond", new Vector3(1, -0.95f, 0));
        fill.material = water;
        fill.shape.SetBox(Vector3.zero, new Vector3(5, 0.9f, 3));
    }

    void AddSpring(PbmpmMaterial water)
    {
        var spring = Make<PbmpmEmitter>("spring", new Vector3(-3.2f, 0, 0));
        spring.material = water;
        spring.disc = false;
        spring.shape.SetBox(Vector3.zero, new Vector3(0.4f, 0.4f, 1));
        spring.direction = Vector3.right;
        spring.speed = 1;
        spring.flow = 0.3f;
    }

    void AddDrain()
    {
        var drain = Make<PbmpmDrain>("drain", new Vector3(3.35f, -0.4f, 0));
        drain.shape.SetBox(Vector3.zero, new Vector3(0.3f, 1.2f, 3));
    }

    void AddRaft()
    {
        var size = new Vector3(1, 0.4f, 0.8f);
        var raft = Make<PbmpmRigidbody>("raft", new Vector3(-0.5f, 0, 0));
        raft.gameObject.AddComponent<BoxCollider>().size = size;
        raft.GetComponent<Rigidbody>().mass = 400 * size.x * size.y * size.z;
        raft.GetComponent<PbmpmCollider>().shape.SetBox(Vector3.zero, size);
    }

    /// <summary>Holds the raft before the end of the world, and lets water pass.</summary>
    void AddRake()
    {
        Make<BoxCollider>("rake", new Vector3(3.4f, 0, 0)).size = new Vector3(0.2f, 4, 4);
    }

    T Make<T>(string label, Vector3 place) where T : Component
    {
        var made = new GameObject(label);
        made.transform.SetParent(transform);
        made.transform.position = place;
        return made.AddComponent<T>();
    }
}
