#if UNITY_5_3_OR_NEWER
using Vector3 = UnityEngine.Vector3;
#else
using Vector3 = System.Numerics.Vector3;
#endif

// The host's vectors in place of plain numbers. In 3D nothing is copied; in 2D their third number is ignored, and 0 where they are
// written.
namespace Pbmpm
{
    public unsafe partial struct Float3
    {
        public static implicit operator Float3(Vector3 vector)
        {
            return *(Float3*)&vector;
        }

        public static implicit operator Vector3(Float3 vector)
        {
            return *(Vector3*)&vector;
        }
    }

    public readonly unsafe partial struct FloatView
    {
        /// <summary>Copies the vectors of all particles to the begin of an array.</summary>
        public void CopyTo(Vector3[] target)
        {
            fixed (Vector3* first = target) window.CopyTo(Numbers.OfVectors(first, target));
        }
    }

    public sealed unsafe partial class World
    {
        /// <summary>Adds particles from arrays: all of them or none.</summary>
        /// <param name="material">Their material.</param>
        /// <param name="positions">[m]; their number says how many particles.</param>
        /// <param name="velocities">[m/s]; null: at rest.</param>
        /// <param name="volumes">Rest volumes [m^d]; null: a cell has room for two particles per axis.</param>
        /// <param name="ids">Receives their identifiers; may be null.</param>
        public void AddParticles(MaterialId material, Vector3[] positions, Vector3[] velocities = null, float[] volumes = null,
                                 ParticleId[] ids = null)
        {
            fixed (Vector3* place = positions, speed = velocities)
            fixed (float* volume = volumes)
            fixed (ParticleId* made = ids)
                AddParticles(material, Numbers.OfVectors(place, positions), Numbers.OfVectors(speed, velocities),
                             Numbers.Plain(volume, volumes), made, Numbers.LengthOf(ids));
        }

        /// <summary>Writes a field of vectors of all particles, in the order of the views.</summary>
        public void Set(Field field, Vector3[] values)
        {
            fixed (Vector3* first = values) Set(field, Numbers.OfVectors(first, values));
        }

        /// <summary>Writes a field of vectors of some particles: all or nothing.</summary>
        public void Set(Field field, ParticleId[] ids, Vector3[] values)
        {
            fixed (ParticleId* chosen = ids)
            fixed (Vector3* first = values)
                Set(field, chosen, Rows(ids, nameof(ids), 1), Numbers.OfVectors(first, values));
        }

        /// <summary>Fields at points [m]; arrays that are not wanted may be null.</summary>
        /// <param name="points">[m].</param>
        /// <param name="filling">Receives for each point how full it is: 1 inside matter, 1/2 on its surface.</param>
        /// <param name="density">Receives the density [kg/m^3] (2D: kg/m^2) of each.</param>
        /// <param name="velocity">Receives that of each [m/s].</param>
        public void QueryPoints(Vector3[] points, float[] filling = null, float[] density = null, Vector3[] velocity = null)
        {
            fixed (Vector3* place = points, speed = velocity)
            fixed (float* full = filling, mass = density)
                QueryPoints(Numbers.OfVectors(place, points), Numbers.Plain(full, filling),
                            Numbers.Plain(mass, density), Numbers.OfVectors(speed, velocity));
        }

        /// <summary>The height of the surface above points, against gravity; negative infinity where there is no matter.</summary>
        /// <param name="points">[m].</param>
        /// <param name="heights">Receives one coordinate along the upward direction for each point [m].</param>
        /// <param name="level">The filling that counts as the surface.</param>
        public void QueryHeights(Vector3[] points, float[] heights, float level = 0.5f)
        {
            fixed (Vector3* place = points)
            fixed (float* height = heights)
                QueryHeights(Numbers.OfVectors(place, points), Numbers.Plain(height, heights), level, null);
        }
    }
}
