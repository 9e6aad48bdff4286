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
            fixed (float* place = points, full = filling, mass = density, speed = velocity)
                QueryPoints(Numbers.Plain(place, points), Numbers.Plain(full, filling),
                            Numbers.Plain(mass, density), Numbers.Plain(speed, velocity));
        }

        void QueryPoints(Numbers points, Numbers filling, Numbers density, Numbers velocity)
        {
            var count = points.Rows(nameof(points), Dimension);
            filling.RequireRows(nameof(filling), 1, count);
            density.RequireRows(nameof(density), 1, count);
            velocity.RequireRows(nameof(velocity), Dimension, count);
            if (count == 0) return; // the address of nothing is null
            fixed (float* narrow = points.Narrowed(Dimension), pairs = velocity.Narrowed(Dimension))
            {
                var place = points.Address(narrow);
                var speed = velocity.Address(pairs);
                Done(Methods.pbmpm_query_points(Id, place, (uint)count, filling.Address(), density.Address(), speed));
                if (pairs != null) velocity.Widen(pairs);
            }
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
            fixed (float* place = points, height = heights)
                QueryHeights(Numbers.Plain(place, points), Numbers.Plain(height, heights), level, up);
        }

        void QueryHeights(Numbers points, Numbers heights, float level, float* up)
        {
            var count = points.Rows(nameof(points), Dimension);
            heights.RequireRoom(nameof(heights), 1, count);
            if (count == 0) return;
            fixed (float* narrow = points.Narrowed(Dimension))
            {
                var place = points.Address(narrow);
                Done(Methods.pbmpm_query_heights(Id, place, (uint)count, up, level, heights.Address()));
            }
        }
    }
}
