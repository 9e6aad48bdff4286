#if NETSTANDARD2_1 || NETSTANDARD2_1_OR_GREATER || NETCOREAPP || UNITY_2021_2_OR_NEWER || PBMPM_SPANS
using System;
using System.Runtime.InteropServices;
#if UNITY_5_3_OR_NEWER
using Vector3 = UnityEngine.Vector3;
#else
using Vector3 = System.Numerics.Vector3;
#endif

// Spans in place of arrays; those of what may be left out may be empty
namespace Pbmpm
{
    public readonly unsafe partial struct FloatView
    {
        /// <summary>All values where those of one particle lie side by side. Not checked after it was taken: it ends with the
        /// next change of the world.</summary>
        /// <exception cref="InvalidOperationException">They do not lie side by side; see <see cref="Component"/>.</exception>
        public ReadOnlySpan<float> Packed
        {
            get
            {
                if (!window.IsPacked) throw new InvalidOperationException("the components of this field lie apart");
                return new ReadOnlySpan<float>((void*)Data, checked(Count * Components));
            }
        }

        /// <summary>One component of all particles where those lie side by side. Not checked after it was taken: it ends with
        /// the next change of the world.</summary>
        /// <exception cref="InvalidOperationException">They do not lie side by side; see <see cref="Packed"/>.</exception>
        public ReadOnlySpan<float> Component(int component)
        {
            if ((uint)component >= (uint)Components) throw new ArgumentOutOfRangeException(nameof(component));
            if (Stride != sizeof(float)) throw new InvalidOperationException("the particles of this field lie apart");
            return new ReadOnlySpan<float>((byte*)Data + component * ComponentStride, Count);
        }

        /// <summary>Copies all values, those of one particle side by side, to the begin of a span.</summary>
        public void CopyTo(Span<float> target)
        {
            fixed (float* first = &MemoryMarshal.GetReference(target)) window.CopyTo(Numbers.Plain(first, target.Length));
        }

        /// <summary>Copies the vectors of all particles to the begin of a span.</summary>
        public void CopyTo(Span<Vector3> target)
        {
            fixed (Vector3* first = &MemoryMarshal.GetReference(target)) window.CopyTo(Numbers.OfVectors(first, target.Length));
        }
    }

    public sealed unsafe partial class World
    {
        /// <summary>Adds particles: as from arrays of numbers.</summary>
        public void AddParticles(MaterialId material, ReadOnlySpan<float> positions, ReadOnlySpan<float> velocities = default,
                                 ReadOnlySpan<float> volumes = default, Span<ParticleId> ids = default)
        {
            fixed (float* place = &MemoryMarshal.GetReference(positions), speed = &MemoryMarshal.GetReference(velocities),
                   volume = &MemoryMarshal.GetReference(volumes))
            fixed (ParticleId* made = &MemoryMarshal.GetReference(ids))
                AddParticles(material, Numbers.Plain(place, positions.Length), Numbers.Plain(speed, Wanted(velocities.Length)),
                             Numbers.Plain(volume, Wanted(volumes.Length)), made, Wanted(ids.Length));
        }

        /// <summary>Adds particles: as from arrays of vectors.</summary>
        public void AddParticles(MaterialId material, ReadOnlySpan<Vector3> positions, ReadOnlySpan<Vector3> velocities = default,
                                 ReadOnlySpan<float> volumes = default, Span<ParticleId> ids = default)
        {
            fixed (Vector3* place = &MemoryMarshal.GetReference(positions), speed = &MemoryMarshal.GetReference(velocities))
            fixed (float* volume = &MemoryMarshal.GetReference(volumes))
            fixed (ParticleId* made = &MemoryMarshal.GetReference(ids))
                AddParticles(material, Numbers.OfVectors(place, positions.Length), Numbers.OfVectors(speed, Wanted(velocities.Length)),
                             Numbers.Plain(volume, Wanted(volumes.Length)), made, Wanted(ids.Length));
        }

        /// <summary>Writes a field of all particles, in the order of the views.</summary>
        public void Set(Field field, ReadOnlySpan<float> values)
        {
            fixed (float* first = &MemoryMarshal.GetReference(values)) Set(field, Numbers.Plain(first, values.Length));
        }

        /// <summary>Writes a field of vectors of all particles, in the order of the views.</summary>
        public void Set(Field field, ReadOnlySpan<Vector3> values)
        {
            fixed (Vector3* first = &MemoryMarshal.GetReference(values)) Set(field, Numbers.OfVectors(first, values.Length));
        }

        /// <summary>Writes a field of some particles: all or nothing.</summary>
        public void Set(Field field, ReadOnlySpan<ParticleId> ids, ReadOnlySpan<float> values)
        {
            fixed (ParticleId* chosen = &MemoryMarshal.GetReference(ids))
            fixed (float* first = &MemoryMarshal.GetReference(values))
                Set(field, chosen, ids.Length, Numbers.Plain(first, values.Length));
        }

        /// <summary>Writes a field of vectors of some particles: all or nothing.</summary>
        public void Set(Field field, ReadOnlySpan<ParticleId> ids, ReadOnlySpan<Vector3> values)
        {
            fixed (ParticleId* chosen = &MemoryMarshal.GetReference(ids))
            fixed (Vector3* first = &MemoryMarshal.GetReference(values))
                Set(field, chosen, ids.Length, Numbers.OfVectors(first, values.Length));
        }

        /// <summary>Fields at points [m]: as for an array of vectors.</summary>
        public void QueryPoints(ReadOnlySpan<Vector3> points, Span<float> filling = default, Span<float> density = default,
                                Span<Vector3> velocity = default)
        {
            fixed (Vector3* place = &MemoryMarshal.GetReference(points), speed = &MemoryMarshal.GetReference(velocity))
            fixed (float* full = &MemoryMarshal.GetReference(filling), mass = &MemoryMarshal.GetReference(density))
                QueryPoints(Numbers.OfVectors(place, points.Length), Numbers.Plain(full, Wanted(filling.Length)),
                            Numbers.Plain(mass, Wanted(density.Length)), Numbers.OfVectors(speed, Wanted(velocity.Length)));
        }

        /// <summary>The height of the surface above points: as for an array of vectors.</summary>
        public void QueryHeights(ReadOnlySpan<Vector3> points, Span<float> heights, float level = 0.5f)
        {
            fixed (Vector3* place = &MemoryMarshal.GetReference(points))
            fixed (float* height = &MemoryMarshal.GetReference(heights))
                QueryHeights(Numbers.OfVectors(place, points.Length), Numbers.Plain(height, heights.Length), level, null);
        }

        static int Wanted(int length)
        {
            return length == 0 ? Numbers.Missing : length;
        }
    }
}
#endif
