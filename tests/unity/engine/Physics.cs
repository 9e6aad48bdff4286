using System.Collections.Generic;

namespace UnityEngine
{
    public enum ForceMode
    {
        Force = 0,
        Impulse = 1,
        VelocityChange = 2,
        Acceleration = 5,
    }

    public class Collider : Component
    {
    }

    public sealed class BoxCollider : Collider
    {
        public Vector3 center { get; set; }
        public Vector3 size { get; set; } = Vector3.one;
    }

    public sealed class SphereCollider : Collider
    {
        public Vector3 center { get; set; }
        public float radius { get; set; } = 0.5f;
    }

    public sealed class CapsuleCollider : Collider
    {
        public Vector3 center { get; set; }
        public float radius { get; set; } = 0.5f;
        public float height { get; set; } = 1;
    }

    public sealed class MeshCollider : Collider
    {
        public Mesh sharedMesh { get; set; }
    }

    public static class Physics
    {
        public static Vector3 gravity { get; set; } = new Vector3(0, -9.81f, 0);

        internal static readonly List<Rigidbody> Bodies = new List<Rigidbody>();

        internal static void Simulate(float seconds)
        {
            for (var i = 0; i < Bodies.Count; i++) Bodies[i].Simulate(seconds);
        }
    }

    /// <summary>A free body; it meets no other. Its tensor is that of a cube of its mass and an edge of a metre.</summary>
    public sealed class Rigidbody : Component
    {
        public Rigidbody()
        {
            Physics.Bodies.Add(this);
        }

        public float mass { get; set; } = 1;
        public bool useGravity { get; set; } = true;
        public Vector3 velocity { get; set; }
        public Vector3 angularVelocity { get; set; }
        public Vector3 position => transform.position;
        public Quaternion rotation => transform.rotation;
        public Vector3 worldCenterOfMass => transform.position;

        public void AddForce(Vector3 force, ForceMode mode)
        {
            velocity += mode == ForceMode.Impulse ? force / mass : force;
        }

        public void AddTorque(Vector3 torque, ForceMode mode)
        {
            angularVelocity += torque / (mass / 6);
        }

        internal void Simulate(float seconds)
        {
            if (useGravity) velocity += Physics.gravity * seconds;
            transform.position += velocity * seconds;
            transform.rotation = Quaternion.AngleAxis(angularVelocity.magnitude * seconds * Mathf.Rad2Deg, angularVelocity) * transform.rotation;
        }

        internal override void End()
        {
            Physics.Bodies.Remove(this);
            base.End();
        }
    }

    public sealed class TerrainData : Object
    {
        internal float[,] Heights = new float[2, 2];

        public int heightmapResolution
        {
            get { return Heights.GetLength(0); }
            set { Heights = new float[value, value]; }
        }

        public Vector3 size { get; set; }

        public float[,] GetHeights(int xBase, int yBase, int width, int height)
        {
            return (float[,])Heights.Clone();
        }

        public void SetHeights(int xBase, int yBase, float[,] heights)
        {
            Heights = (float[,])heights.Clone();
        }
    }

    public sealed class Terrain : Behaviour
    {
        public static GameObject CreateTerrainGameObject(TerrainData assignTerrain)
        {
            var made = new GameObject("Terrain");
            made.AddComponent<Terrain>();
            return made;
        }
    }
}
