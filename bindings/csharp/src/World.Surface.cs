using System;
using Pbmpm.Native;

namespace Pbmpm
{
    // What is drawn: the surface of matter, and particles as points
    public sealed unsafe partial class World
    {
        /// <summary>How many vertices and indices the surface has, in 3D.</summary>
        public SurfaceCounts CountSurface(SurfaceDef definition)
        {
            var mesh = new SurfaceMesh { Size = (uint)sizeof(SurfaceMesh) };
            Done(Methods.pbmpm_surface_extract(Id, &definition, &mesh));
            return new SurfaceCounts(mesh);
        }

        /// <summary>The surface with the defaults: all matter, two points per cell.</summary>
        /// <param name="positions">[m]; one for each vertex.</param>
        /// <param name="normals">As many unit vectors, or null.</param>
        /// <param name="indices">Three for each triangle, counterclockwise from outside.</param>
        /// <param name="counts">How many vertices and indices there are.</param>
        /// <returns>Whether there was room; else nothing was written but the counts. Larger arrays get it without working it out again.</returns>
        public bool TryMakeSurface(Float3[] positions, Float3[] normals, uint[] indices, out SurfaceCounts counts)
        {
            return TryMakeSurface(SurfaceDef.Default, positions, normals, indices, out counts);
        }

        /// <summary>The same of chosen materials, or in another way; begin with <see cref="SurfaceDef.Default"/>. Its indices are of 4 bytes.</summary>
        public bool TryMakeSurface(SurfaceDef definition, Float3[] positions, Float3[] normals, uint[] indices, out SurfaceCounts counts)
        {
            if (positions == null) throw new ArgumentNullException(nameof(positions));
            if (indices == null) throw new ArgumentNullException(nameof(indices));
            definition.IndexBytes = sizeof(uint);
            fixed (Float3* place = positions, normal = normals)
            fixed (uint* index = indices)
            {
                var mesh = new SurfaceMesh
                {
                    Positions = (float*)place, Normals = (float*)normal, Indices = (IntPtr)index,
                    VertexCapacity = (uint)(normals == null ? positions.Length : Math.Min(positions.Length, normals.Length)),
                    IndexCapacity = (uint)indices.Length
                };
                return TryMakeSurface(definition, ref mesh, out counts);
            }
        }

        /// <summary>The same into memory of the host: a mapped buffer of the GPU, records of its own. <paramref name="mesh"/> says where it goes and gets the counts.</summary>
        public bool TryMakeSurface(SurfaceDef definition, ref SurfaceMesh mesh, out SurfaceCounts counts)
        {
            mesh.Size = (uint)sizeof(SurfaceMesh);
            Result result;
            fixed (SurfaceMesh* at = &mesh) result = Methods.pbmpm_surface_extract(Id, &definition, at);
            counts = new SurfaceCounts(mesh);
            if (result == Result.ErrorCapacity) return false;
            Done(result);
            return true;
        }

        /// <summary>All particles as white points to draw. Returns how many there are.</summary>
        /// <param name="points">At least ParticleCount of them.</param>
        public int CopyPoints(Point[] points)
        {
            return CopyPoints(PointsDef.Default, points);
        }

        /// <summary>The same of chosen particles, in other colours; begin with <see cref="PointsDef.Default"/>.</summary>
        public int CopyPoints(PointsDef definition, Point[] points)
        {
            if (points == null) throw new ArgumentNullException(nameof(points));
            uint count;
            fixed (Point* first = points) Done(Methods.pbmpm_surface_points(Id, &definition, first, (uint)points.Length, &count));
            return (int)count;
        }
    }

    /// <summary>How large a surface is.</summary>
    public struct SurfaceCounts
    {
        /// <summary>Vertices.</summary>
        public int Vertices;

        /// <summary>Indices, three for each triangle.</summary>
        public int Indices;

        internal SurfaceCounts(SurfaceMesh mesh)
        {
            Vertices = checked((int)mesh.VertexCount);
            Indices = checked((int)mesh.IndexCount);
        }
    }
}
