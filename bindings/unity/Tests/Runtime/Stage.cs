using NUnit.Framework;
using Pbmpm.Components;
using UnityEngine;

namespace Pbmpm.Tests
{
    /// <summary>A closed tank of 2 m around the origin for a test, and what goes into it.</summary>
    internal sealed class Stage
    {
        readonly GameObject body;

        public readonly PbmpmWorld World;
        public readonly PbmpmLiquid Water = ScriptableObject.CreateInstance<PbmpmLiquid>();

        public Stage()
        {
            body = new GameObject("tank");
            body.SetActive(false);
            World = body.AddComponent<PbmpmWorld>();
            World.size = new Vector3(2, 2, 2);
            World.cellSize = 0.125f;
            World.capacity = 17000;
            World.threads = 1;
        }

        public void Begin()
        {
            body.SetActive(true);
        }

        public void End()
        {
            Object.DestroyImmediate(body);
        }

        /// <summary>A part in an object of its own below the world.</summary>
        public T Add<T>(Vector3 place) where T : Component
        {
            var made = new GameObject(typeof(T).Name);
            made.transform.SetParent(body.transform);
            made.transform.position = place;
            return made.AddComponent<T>();
        }

        /// <summary>Water on the floor, 1 m high.</summary>
        public PbmpmFill AddPool()
        {
            var fill = Add<PbmpmFill>(new Vector3(0, -0.5f, 0));
            fill.material = Water;
            fill.shape.SetBox(Vector3.zero, new Vector3(2, 1, 2));
            return fill;
        }

        public PbmpmFill AddBlock(PbmpmMaterial material)
        {
            var fill = Add<PbmpmFill>(new Vector3(0, 0.2f, 0));
            fill.material = material;
            fill.shape.SetBox(Vector3.zero, new Vector3(0.6f, 0.6f, 0.6f));
            return fill;
        }

        /// <summary>Steps without frames: these have the lengths that a machine gives.</summary>
        public void Step(int steps)
        {
            for (var i = 0; i < steps; i++) World.Advance(World.StepSeconds);
        }
    }

    /// <summary>Tests that have a tank each.</summary>
    public abstract class StageTests
    {
        internal Stage stage;

        [SetUp]
        public void SetUp()
        {
            stage = new Stage();
        }

        [TearDown]
        public void TearDown()
        {
            stage.End();
        }
    }
}
