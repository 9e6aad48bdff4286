using System;
#if UNITY_5_3_OR_NEWER
using Vector3 = UnityEngine.Vector3;
#else
using Vector3 = System.Numerics.Vector3;
#endif

namespace Pbmpm
{
    /// <summary>Numbers of the host in memory that does not move while this is used, so that one function serves arrays, spans and
    /// native arrays of numbers and of vectors.</summary>
    internal readonly unsafe struct Numbers
    {
        readonly float* first;
        readonly int length;

        /// <summary>Whether they are vectors of three, whatever the world's dimension.</summary>
        readonly bool wide;

        Numbers(float* first, int length, bool wide)
        {
            this.first = first;
            this.length = length;
            this.wide = wide;
        }

        /// <summary>The length of an array that is not there.</summary>
        public const int Missing = -1;

        public static int LengthOf(Array array)
        {
            return array == null ? Missing : array.Length;
        }

        /// <param name="first">May be null when there are none.</param>
        /// <param name="count">How many; or <see cref="Missing"/>.</param>
        public static Numbers Plain(float* first, int count)
        {
            return new Numbers(first, count, false);
        }

        /// <summary>Those of an array that is held fast at its first one.</summary>
        public static Numbers Plain(float* first, float[] array)
        {
            return Plain(first, LengthOf(array));
        }

        /// <param name="first">May be null when there are none.</param>
        /// <param name="count">How many vectors; or <see cref="Missing"/>.</param>
        public static Numbers OfVectors(void* first, int count)
        {
            return new Numbers((float*)first, count == Missing ? Missing : checked(count * 3), true);
        }

        /// <summary>Those of an array that is held fast at its first one.</summary>
        public static Numbers OfVectors(Vector3* first, Vector3[] array)
        {
            return OfVectors(first, LengthOf(array));
        }

        public bool IsGiven => length != Missing;

        /// <summary>Where the library finds them.</summary>
        /// <param name="narrow">What <see cref="Narrowed"/> gave, held fast.</param>
        public float* Address(float* narrow = null)
        {
            return narrow != null ? narrow : first;
        }

        /// <summary>How many rows of so many columns there are.</summary>
        public int Rows(string name, int columns)
        {
            if (!IsGiven) throw new ArgumentNullException(name);
            var width = Width(name, columns);
            if (length % width != 0) throw new ArgumentException("the length is no multiple of " + width, name);
            return length / width;
        }

        /// <summary>Throws unless they are missing or of so many rows.</summary>
        public void RequireRows(string name, int columns, int rows)
        {
            if (!IsGiven) return;
            var width = Width(name, columns);
            if (length != rows * width)
                throw new ArgumentException("the length is " + Shown(length) + " instead of " + Shown(rows * width), name);
        }

        /// <summary>Throws unless there is room for so many rows.</summary>
        public void RequireRoom(string name, int columns, int rows)
        {
            if (!IsGiven) throw new ArgumentNullException(name);
            var needed = (long)rows * Width(name, columns);
            if (length < needed) throw new ArgumentException("the length is " + Shown(length) + ", too few for " + Shown(needed), name);
        }

        /// <summary>Whether they must be repacked, since the library takes two numbers per row in 2D.</summary>
        public bool IsWiderThan(int columns)
        {
            return wide && columns == 2 && length > 0;
        }

        /// <summary>The first two numbers of each vector, or null when they are packed as the library wants them.</summary>
        public float[] Narrowed(int columns)
        {
            if (!IsWiderThan(columns)) return null;
            var narrow = new float[length / 3 * 2];
            for (var i = 0; i < narrow.Length; i++) narrow[i] = first[i / 2 * 3 + i % 2];
            return narrow;
        }

        /// <summary>Takes over pairs of numbers; the third of each vector becomes 0.</summary>
        public void Widen(float* pairs)
        {
            for (var i = 0; i < length; i++) first[i] = i % 3 < 2 ? pairs[i / 3 * 2 + i % 3] : 0;
        }

        int Width(string name, int columns)
        {
            if (wide && columns != 2 && columns != 3) throw new ArgumentException("vectors are no rows of " + columns, name);
            return wide ? 3 : columns;
        }

        long Shown(long count)
        {
            return wide ? count / 3 : count;
        }
    }
}
