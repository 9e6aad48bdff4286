namespace Pbmpm.Native
{
    /// <summary>Where a field, or with an empty field name a whole structure, lies in memory.</summary>
    internal readonly unsafe struct MirrorField
    {
        public readonly string Structure;
        public readonly string Field;
        public readonly uint Offset;
        public readonly uint Size;

        /// <summary>A later version may have appended fields; true only for a structure that begins with its size.</summary>
        public readonly bool MayGrow;

        /// <summary>The addresses are taken from a real structure, so they tell what compiler and run time made of the
        /// declaration, without reflection.</summary>
        public MirrorField(string structure, string field, void* start, void* begin, void* end, bool mayGrow)
        {
            Structure = structure;
            Field = field;
            Offset = (uint)((byte*)begin - (byte*)start);
            Size = (uint)((byte*)end - (byte*)begin);
            MayGrow = mayGrow;
        }

        public string Name => Field.Length == 0 ? Structure : Structure + "." + Field;

        public bool Fits(uint offset, uint size)
        {
            return offset == Offset && (size == Size || (MayGrow && size > Size));
        }
    }
}
