using System;
using UnityEngine;

namespace Pbmpm.Components
{
    /// <summary>Kinds of shapes.</summary>
    public enum Form
    {
        Box,
        Sphere,
        Capsule,
        /// <summary>Half space below the local x-z plane.</summary>
        Plane,
        /// <summary>A mesh or a terrain that was baked.</summary>
        Solid,
    }

    /// <summary>A shape around a transform. Lengths are in the transform's units, so its scale counts; balls and capsules take the largest
    /// of its three. Baked solids keep the size that they were baked with.</summary>
    [Serializable]
    public sealed class MatterShape
    {
        [Tooltip("What it is.")]
        public Form form = Form.Box;

        [Tooltip("Middle, from the transform [m].")]
        public Vector3 center;

        [Tooltip("Box: edge lengths [m].")]
        public Vector3 size = new Vector3(1, 1, 1);

        [Tooltip("Sphere, capsule, nozzle of an emitter [m].")]
        public float radius = 0.5f;

        [Tooltip("Capsule: from tip to tip, along the local y axis [m].")]
        public float height = 2;

        [Tooltip("The asset with the baked mesh or terrain.")]
        public PbmpmSolid solid;

        // The library's capsules lie along their first axis, those of Unity along the second
        static readonly Quaternion Upright = new Quaternion(0, 0, 0.70710678f, 0.70710678f);

        /// <summary>As the library takes it.</summary>
        internal Shape At(PbmpmWorld world, Placement place)
        {
            var it = Shape.Default;
            it.Kind = Kind;
            it.Position = world.Inward(Middle(place));
            it.Rotation = Places.Of(Turn(place));
            it.HalfExtents = form == Form.Capsule ? new Vector3(Shaft(place.Scale), 0, 0) : Vector3.Scale(size, Positive(place.Scale)) * 0.5f;
            it.Radius = Round(place.Scale);
            if (form == Form.Solid) it.Baked = world.Loaded(solid);
            return it;
        }

        /// <summary>Where its middle is.</summary>
        internal Vector3 Middle(Placement place)
        {
            return place.Position + place.Rotation * Vector3.Scale(center, place.Scale);
        }

        /// <summary>How the library's shape is turned.</summary>
        internal Quaternion Turn(Placement place)
        {
            return form == Form.Capsule ? place.Rotation * Upright : place.Rotation;
        }

        /// <summary>Takes the measures of one of Unity's colliders; false for kinds that have to be baked.</summary>
        public bool CopyFrom(Collider collider)
        {
            var box = collider as BoxCollider;
            var sphere = collider as SphereCollider;
            var capsule = collider as CapsuleCollider;
            if (box != null) SetBox(box.center, box.size);
            if (sphere != null) SetSphere(sphere.center, sphere.radius);
            if (capsule != null) SetCapsule(capsule.center, capsule.radius, capsule.height);
            return box != null || sphere != null || capsule != null;
        }

        /// <summary>A box with its middle and edges [m].</summary>
        public void SetBox(Vector3 middle, Vector3 edges)
        {
            form = Form.Box;
            center = middle;
            size = edges;
        }

        /// <summary>A ball with its middle and radius [m].</summary>
        public void SetSphere(Vector3 middle, float newRadius)
        {
            form = Form.Sphere;
            center = middle;
            radius = newRadius;
        }

        /// <summary>A capsule with its middle, its radius, and its length from tip to tip along y [m].</summary>
        public void SetCapsule(Vector3 middle, float newRadius, float newHeight)
        {
            form = Form.Capsule;
            center = middle;
            radius = newRadius;
            height = newHeight;
        }

        /// <summary>Outlines, for OnDrawGizmos.</summary>
        internal void DrawGizmo(Placement place, Color color)
        {
            Gizmos.color = color;
            Gizmos.matrix = Matrix4x4.TRS(Middle(place), place.Rotation, Vector3.one);
            var round = Round(place.Scale);
            switch (form)
            {
                case Form.Box:
                    Gizmos.DrawWireCube(Vector3.zero, Vector3.Scale(size, Positive(place.Scale)));
                    break;
                case Form.Sphere:
                    Gizmos.DrawWireSphere(Vector3.zero, round);
                    break;
                case Form.Capsule:
                    var tip = new Vector3(0, Shaft(place.Scale), 0);
                    Gizmos.DrawWireSphere(tip, round);
                    Gizmos.DrawWireSphere(-tip, round);
                    Gizmos.DrawLine(tip + Vector3.right * round, Vector3.right * round - tip);
                    Gizmos.DrawLine(tip - Vector3.right * round, -Vector3.right * round - tip);
                    break;
                case Form.Plane:
                    Gizmos.DrawWireCube(Vector3.zero, new Vector3(2, 0, 2));
                    Gizmos.DrawLine(Vector3.zero, Vector3.up);
                    break;
                case Form.Solid:
                    if (solid != null) Gizmos.DrawWireCube(solid.Middle, solid.Size);
                    break;
            }
            Gizmos.matrix = Matrix4x4.identity;
        }

        ShapeKind Kind
        {
            get
            {
                switch (form)
                {
                    case Form.Sphere: return ShapeKind.Sphere;
                    case Form.Capsule: return ShapeKind.Capsule;
                    case Form.Plane: return ShapeKind.Plane;
                    case Form.Solid: return ShapeKind.Baked;
                    default: return ShapeKind.Box;
                }
            }
        }

        float Round(Vector3 scale)
        {
            var sizes = Positive(scale);
            return radius * Mathf.Max(sizes.x, Mathf.Max(sizes.y, sizes.z));
        }

        float Shaft(Vector3 scale)
        {
            return Mathf.Max(0, height * Mathf.Abs(scale.y) * 0.5f - Round(scale));
        }

        static Vector3 Positive(Vector3 scale)
        {
            return new Vector3(Mathf.Abs(scale.x), Mathf.Abs(scale.y), Mathf.Abs(scale.z));
        }
    }
}
