using Pbmpm.Native;

namespace Pbmpm
{
    // What matter is where. Points are arrays of Dimension numbers each [m].
    public sealed unsafe partial class World
    {
        /// <summary>The first point along a ray that is inside matter; begin with <see cref="Ray.Default"/>.</summary>
        public RayHit Cast(Ray ray)
        {
            var hit = new RayHit { Size = (uint)sizeof(RayHit) };
            Done(Methods.pbmpm_query_ray(Id, &ray, &hit));
            return hit;
        }

        /// <summary>Particles, mass and volume inside a shape by material. Writes as many entries as there is room for and
        /// returns the full number.</summary>
        public int QueryRegion(Shape shape, RegionShare[] shares)
        {
            uint count;
            var room = (uint)Rows(shares, nameof(shares), 1);
            if (room > 0) shares[0].Size = (uint)sizeof(RegionShare);
            fixed (RegionShare* first = shares) Done(Methods.pbmpm_query_region(Id, &shape, first, room, &count));
            return (int)count;
        }

        /// <summary>Fields at points; arrays that are not wanted may be null.</summary>
        /// <param name="points">Dimension numbers per point [m].</param>
        /// <param name="filling">Receives for each point how full it is: 1 inside matter, 1/2 on its surface.</param>
        /// <param name="density">Receives the density [kg/m^3] (2D: kg/m^2) of each.</param>
        /// <param name="velocity">Receives Dimension numbers for each [m/s].</param>
        public void QueryPoints(float[] points, float[] filling = null, float[] density = null, float[] velocity = null)
        {
            var count = Rows(points, nameof(points), Dimension);
            RequireLength(filling, nameof(filling), count);
            RequireLength(density, nameof(density), count);
            RequireLength(velocity, nameof(velocity), points.Length);
            if (count == 0) return; // the address of nothing is null
            fixed (float* place = points, full = filling, mass = density, speed = velocity)
                Done(Methods.pbmpm_query_points(Id, place, (uint)count, full, mass, speed));
        }

        /// <summary>The height of the surface above points, against gravity; negative infinity where there is no matter.</summary>
        /// <param name="points">Dimension numbers per point [m].</param>
        /// <param name="heights">Receives one coordinate along the upward direction for each point [m].</param>
        /// <param name="level">The filling that counts as the surface.</param>
        public void QueryHeights(float[] points, float[] heights, float level = 0.5f)
        {
            QueryHeights(points, heights, level, null);
        }

        /// <summary>The same along another direction than gravity's opposite.</summary>
        public void QueryHeights(float[] points, float[] heights, float level, Float3 up)
        {
            QueryHeights(points, heights, level, &up.X);
        }

        void QueryHeights(float[] points, float[] heights, float level, float* up)
        {
            var count = Rows(points, nameof(points), Dimension);
            RequireRoom(heights, nameof(heights), count);
            if (count == 0) return;
            fixed (float* place = points, height = heights)
                Done(Methods.pbmpm_query_heights(Id, place, (uint)count, up, level, height));
        }
    }
}
