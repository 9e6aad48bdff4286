using UnityEngine;

namespace Pbmpm.Components
{
    /// <summary>Unity's numbers as the library takes them. Both measure in metres. The library knows no handedness: a rotation, a turn
    /// and a torque follow from the same products in Unity's left-handed axes. So numbers go over as they are.</summary>
    internal static class Places
    {
        public static Float4 Of(Quaternion rotation)
        {
            return new Float4(rotation.x, rotation.y, rotation.z, rotation.w);
        }

        public static Vector3 Of(Double3 vector)
        {
            return new Vector3((float)vector.X, (float)vector.Y, (float)vector.Z);
        }

        public static Double3 Exact(Vector3 vector)
        {
            return new Double3(vector.x, vector.y, vector.z);
        }

        /// <summary>The rotation after some seconds of a turn [rad/s].</summary>
        public static Quaternion Turned(Quaternion rotation, Vector3 turn, float seconds)
        {
            var angle = turn.magnitude * seconds;
            return angle > 0 ? Quaternion.AngleAxis(angle * Mathf.Rad2Deg, turn) * rotation : rotation;
        }
    }

    /// <summary>Where something stands, how it is turned and how large it is.</summary>
    internal struct Placement
    {
        public Vector3 Position;
        public Quaternion Rotation;
        public Vector3 Scale; // of the transform, in the world

        public static Placement Of(Transform transform)
        {
            return new Placement { Position = transform.position, Rotation = transform.rotation, Scale = transform.lossyScale };
        }

        public bool StandsAs(Placement other)
        {
            return Position == other.Position && Rotation == other.Rotation;
        }
    }
}
