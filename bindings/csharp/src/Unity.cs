#if UNITY_5_3_OR_NEWER
using Unity.Collections;
using Unity.Collections.LowLevel.Unsafe;
using UnityEngine;

// Unity's native arrays in place of managed ones; those of what may be left out may be default ones
namespace Pbmpm
{
    public readonly unsafe partial struct FloatView
    {
        /// <summary>Copies the vectors of all particles to the begin of an array.</summary>
        public void CopyTo(NativeArray<Vector3> target)
        {
            window.CopyTo(World.Written(target));
        }
    }

    public sealed unsafe partial class World
    {
        /// <summary>Adds particles: as from managed arrays of vectors.</summary>
        public void AddParticles(MaterialId material, NativeArray<Vector3> positions, NativeArray<Vector3> velocities = default,
                                 NativeArray<float> volumes = default, NativeArray<ParticleId> ids = default)
        {
            var made = ids.IsCreated ? (ParticleId*)ids.GetUnsafePtr() : null;
            AddParticles(material, Read(positions), Read(velocities), Read(volumes), made, LengthOf(ids));
        }

        /// <summary>Writes a field of vectors of all particles, in the order of the views.</summary>
        public void Set(Field field, NativeArray<Vector3> values)
        {
            Set(field, Read(values));
        }

        /// <summary>Writes a field of vectors of some particles: all or nothing.</summary>
        public void Set(Field field, NativeArray<ParticleId> ids, NativeArray<Vector3> values)
        {
            Set(field, (ParticleId*)ids.GetUnsafeReadOnlyPtr(), ids.Length, Read(values));
        }

        /// <summary>Fields at points [m]: as for managed arrays of vectors.</summary>
        public void QueryPoints(NativeArray<Vector3> points, NativeArray<float> filling = default, NativeArray<float> density = default,
                                NativeArray<Vector3> velocity = default)
        {
            QueryPoints(Read(points), Written(filling), Written(density), Written(velocity));
        }

        /// <summary>The height of the surface above points: as for managed arrays of vectors.</summary>
        public void QueryHeights(NativeArray<Vector3> points, NativeArray<float> heights, float level = 0.5f)
        {
            QueryHeights(Read(points), Written(heights), level, null);
        }

        // Unity notes who reads and who writes

        static Numbers Read(NativeArray<Vector3> array)
        {
            return Numbers.OfVectors(array.IsCreated ? array.GetUnsafeReadOnlyPtr() : null, LengthOf(array));
        }

        static Numbers Read(NativeArray<float> array)
        {
            return Numbers.Plain(array.IsCreated ? (float*)array.GetUnsafeReadOnlyPtr() : null, LengthOf(array));
        }

        internal static Numbers Written(NativeArray<Vector3> array)
        {
            return Numbers.OfVectors(array.IsCreated ? array.GetUnsafePtr() : null, LengthOf(array));
        }

        static Numbers Written(NativeArray<float> array)
        {
            return Numbers.Plain(array.IsCreated ? (float*)array.GetUnsafePtr() : null, LengthOf(array));
        }

        static int LengthOf<T>(NativeArray<T> array) where T : struct
        {
            return array.IsCreated ? array.Length : Numbers.Missing;
        }
    }
}
#endif
