namespace Pbmpm
{
    public partial struct Shape
    {
        /// <summary>The half space behind a plane (2D: a line) through a point; the normal points out of it.</summary>
        public static Shape Plane(Float3 point, Float3 normal)
        {
            var it = At(ShapeKind.Plane, point);
            it.Normal = normal;
            return it;
        }

        /// <summary>A box (2D: a rectangle) with its half extents [m].</summary>
        public static Shape Box(Float3 center, Float3 halfExtents)
        {
            var it = At(ShapeKind.Box, center);
            it.HalfExtents = halfExtents;
            return it;
        }

        /// <summary>A ball (2D: a disc) with its radius [m].</summary>
        public static Shape Sphere(Float3 center, float radius)
        {
            var it = At(ShapeKind.Sphere, center);
            it.Radius = radius;
            return it;
        }

        /// <summary>All points within a radius [m] of a segment along the local first axis with this half length [m].</summary>
        public static Shape Capsule(Float3 center, float halfLength, float radius)
        {
            var it = At(ShapeKind.Capsule, center);
            it.HalfExtents.X = halfLength;
            it.Radius = radius;
            return it;
        }

        /// <summary>A baked solid of the same world; the position is where the origin of its mesh stands.</summary>
        public static Shape Solid(Float3 position, BakedId solid)
        {
            var it = At(ShapeKind.Baked, position);
            it.Baked = solid;
            return it;
        }

        static Shape At(ShapeKind kind, Float3 position)
        {
            var it = Default;
            it.Kind = kind;
            it.Position = position;
            return it;
        }
    }
}
