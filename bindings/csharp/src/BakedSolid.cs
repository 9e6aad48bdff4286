using System;
using Pbmpm.Native;

namespace Pbmpm
{
    /// <summary>A solid of any form as a grid of distances. Baking takes up to some seconds: do it once, keep
    /// <see cref="Data"/> in a file, and load that.</summary>
    public sealed unsafe class BakedSolid
    {
        /// <summary>The bytes to keep.</summary>
        public byte[] Data { get; }

        /// <summary>What it is.</summary>
        public BakedInfo Info { get; }

        /// <summary>A solid that was baked before.</summary>
        /// <exception cref="PbmpmException">The bytes are damaged, or of another version.</exception>
        public BakedSolid(byte[] data)
        {
            if (data == null) throw new ArgumentNullException(nameof(data));
            Library.Check();
            var info = new BakedInfo { Size = (uint)sizeof(BakedInfo) };
            fixed (byte* first = data) Library.Require(Methods.pbmpm_baked_inspect((IntPtr)first, (ulong)data.Length, &info));
            Data = data;
            Info = info;
        }

        /// <summary>Bakes a closed mesh: triangles in 3D, the edges of polygons in 2D, all wound one way.</summary>
        /// <param name="dimension">2 or 3.</param>
        /// <param name="vertices">Dimension numbers per vertex [m].</param>
        /// <param name="elements">Dimension indices of vertices per element.</param>
        /// <param name="resolution">Grid cells along the longest side.</param>
        public static BakedSolid FromMesh(int dimension, float[] vertices, uint[] elements, int resolution = 64)
        {
            if (elements == null) throw new ArgumentNullException(nameof(elements));
            return Bake(Methods.pbmpm_bake_mesh, dimension, vertices, elements, resolution);
        }

        /// <summary>Bakes the convex hull of points.</summary>
        public static BakedSolid FromHull(int dimension, float[] vertices, int resolution = 64)
        {
            return Bake(Methods.pbmpm_bake_hull, dimension, vertices, new uint[0], resolution);
        }

        /// <summary>Bakes terrain: heights [m] over a regular lattice, solid from there down to its base.</summary>
        /// <param name="dimension">2 or 3.</param>
        /// <param name="heights">Sample (i, j) is heights[i + j * count.X].</param>
        /// <param name="count">Samples along the axes that are not <paramref name="up"/>; in 2D the second is not used.</param>
        /// <param name="spacing">From one sample to the next along them [m].</param>
        /// <param name="up">The axis along which heights are measured.</param>
        /// <param name="thickness">How far the base lies below the lowest sample [m].</param>
        /// <param name="resolution">Grid cells along the longest side; 0: as wide as the lattice's.</param>
        public static BakedSolid FromHeights(int dimension, float[] heights, Uint2 count, Float2 spacing, int up = 1,
                                             float thickness = 1, int resolution = 0)
        {
            if (heights == null) throw new ArgumentNullException(nameof(heights));
            var samples = (long)count.X * (dimension == 2 ? 1 : count.Y);
            if (heights.Length != samples)
                throw new ArgumentException("the length is " + heights.Length + " instead of " + samples, nameof(heights));
            var definition = HeightsDef.Default;
            definition.Dimension = dimension;
            definition.Up = up;
            definition.Resolution = resolution;
            definition.Count = count;
            definition.Spacing = spacing;
            definition.Thickness = thickness;
            fixed (float* first = heights)
            {
                definition.Heights = first;
                ulong bytes;
                Library.Require(Methods.pbmpm_bake_heights(&definition, IntPtr.Zero, 0, &bytes));
                var data = new byte[bytes];
                fixed (byte* target = data)
                    Library.Require(Methods.pbmpm_bake_heights(&definition, (IntPtr)target, bytes, &bytes));
                return new BakedSolid(data);
            }
        }

        delegate Result Baker(MeshDef* definition, IntPtr buffer, ulong capacity, ulong* bytes);

        static BakedSolid Bake(Baker bake, int dimension, float[] vertices, uint[] elements, int resolution)
        {
            if (vertices == null) throw new ArgumentNullException(nameof(vertices));
            var definition = MeshDef.Default;
            definition.Dimension = dimension;
            definition.Resolution = resolution;
            definition.VertexCount = Share(vertices, nameof(vertices), dimension);
            definition.ElementCount = Share(elements, nameof(elements), dimension);
            fixed (float* place = vertices)
            fixed (uint* corner = elements)
            {
                definition.Vertices = place;
                definition.Elements = corner;
                ulong bytes;
                Library.Require(bake(&definition, IntPtr.Zero, 0, &bytes));
                var data = new byte[bytes];
                fixed (byte* target = data) Library.Require(bake(&definition, (IntPtr)target, bytes, &bytes));
                return new BakedSolid(data);
            }
        }

        static uint Share(Array array, string name, int dimension)
        {
            if (dimension != 2 && dimension != 3) throw new ArgumentOutOfRangeException(nameof(dimension));
            if (array.Length % dimension != 0) throw new ArgumentException("the length is no multiple of " + dimension, name);
            return (uint)(array.Length / dimension);
        }
    }

    public sealed unsafe partial class World
    {
        /// <summary>Copies a baked solid into the world; any number of obstacles share it, see <see cref="Shape.Solid"/>.</summary>
        public BakedId Load(BakedSolid solid)
        {
            if (solid == null) throw new ArgumentNullException(nameof(solid));
            BakedId made;
            fixed (byte* first = solid.Data) Done(Methods.pbmpm_baked_create(Id, (IntPtr)first, (ulong)solid.Data.Length, &made));
            return made;
        }

        /// <summary>Takes a solid out of the world; refused while an obstacle has its shape.</summary>
        public void Unload(BakedId solid)
        {
            Done(Methods.pbmpm_baked_destroy(Id, solid));
        }

        /// <summary>What matter gave in the last step to an obstacle that measures it.</summary>
        public Impulse ImpulseOn(ColliderId collider)
        {
            var found = new Impulse { Size = (uint)sizeof(Impulse) };
            Done(Methods.pbmpm_collider_impulse(Id, collider, &found));
            return found;
        }

        /// <summary>What matter gave in the last step to a wall of a domain that measures it.</summary>
        public Impulse ImpulseOnWall(int axis, bool upper)
        {
            var found = new Impulse { Size = (uint)sizeof(Impulse) };
            Done(Methods.pbmpm_domain_impulse(Id, axis, upper ? 1 : 0, &found));
            return found;
        }
    }
}
