using Pbmpm;
using Pbmpm.Components;
using UnityEngine;

/// <summary>Water, jelly, sand and clay, and a hand that grabs what is under the mouse. Put it on an empty object of a scene with a camera,
/// and play. Without Unity's old input manager the hand goes round by itself.</summary>
public sealed class Sandbox : MonoBehaviour
{
    PbmpmForce hand;
#if ENABLE_LEGACY_INPUT_MANAGER
    PbmpmWorld world;
    float reach;
#endif

    void Awake()
    {
        var made = AddWorld();
        AddBlock<PbmpmLiquid>(new Vector3(-1.2f, -0.5f, 0), new Color(0.2f, 0.5f, 0.9f));
        AddBlock<PbmpmElastic>(new Vector3(-0.4f, -0.5f, 0), new Color(0.9f, 0.3f, 0.4f)).youngModulus = 2e4f;
        AddBlock<PbmpmSand>(new Vector3(0.4f, -0.5f, 0), new Color(0.9f, 0.8f, 0.5f)).youngModulus = 1e5f;
        AddBlock<PbmpmVisco>(new Vector3(1.2f, -0.5f, 0), new Color(0.6f, 0.4f, 0.3f)).youngModulus = 5e4f;
        hand = new GameObject("hand").AddComponent<PbmpmForce>();
        hand.transform.SetParent(transform);
        hand.kind = ForceKind.Grab;
        hand.shape.SetSphere(Vector3.zero, 0.25f);
        hand.acts = false;
#if ENABLE_LEGACY_INPUT_MANAGER
        world = made;
#endif
        if (Camera.main != null) Camera.main.transform.position = made.transform.position + new Vector3(0, 0, -4);
    }

    PbmpmWorld AddWorld()
    {
        var body = new GameObject("world");
        body.SetActive(false);
        body.transform.SetParent(transform);
        var made = body.AddComponent<PbmpmWorld>();
        made.size = new Vector3(3.2f, 2, 1.2f);
        made.cellSize = 0.1f;
        made.wallFriction = 0.5f;
        body.AddComponent<PbmpmPoints>();
        body.AddComponent<PbmpmHud>();
        body.SetActive(true);
        return made;
    }

    T AddBlock<T>(Vector3 place, Color color) where T : PbmpmMaterial
    {
        var fill = new GameObject(typeof(T).Name).AddComponent<PbmpmFill>();
        fill.transform.SetParent(transform);
        fill.transform.position = place;
        fill.shape.SetBox(Vector3.zero, new Vector3(0.7f, 0.9f, 0.8f));
        var material = ScriptableObject.CreateInstance<T>();
        material.color = color;
        fill.material = material;
        return material;
    }

    void Update()
    {
#if ENABLE_LEGACY_INPUT_MANAGER
        if (Camera.main == null) return;
        var ray = Camera.main.ScreenPointToRay(Input.mousePosition);
        if (Input.GetMouseButtonDown(0)) Grab(ray);
        if (Input.GetMouseButton(0) && hand.acts) Drag(ray.origin + ray.direction * reach);
        else Release();
#else
        hand.acts = true;
        Drag(new Vector3(Mathf.Sin(Time.time), 0.4f * Mathf.Sin(2 * Time.time) - 0.3f, 0));
#endif
    }

#if ENABLE_LEGACY_INPUT_MANAGER
    void Grab(UnityEngine.Ray line)
    {
        var ray = Pbmpm.Ray.Default;
        ray.Origin = world.Inward(line.origin);
        ray.Direction = line.direction;
        var hit = world.Simulation.Cast(ray);
        if (hit.Hit == 0) return;
        reach = hit.Distance;
        hand.transform.position = world.Outward(hit.Position);
        hand.acts = true;
    }

    void Release()
    {
        if (!hand.acts) return;
        hand.acts = false;
        hand.Change();
    }
#endif

    /// <summary>Matter in the hand takes on the velocity that brings it there.</summary>
    void Drag(Vector3 place)
    {
        var way = place - hand.transform.position;
        hand.velocity = way / Mathf.Max(Time.deltaTime, 1e-3f);
        hand.transform.position = place;
        hand.Change();
    }
}
