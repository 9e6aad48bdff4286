using System;
using System.Runtime.InteropServices;
using Unity.Collections.LowLevel.Unsafe;

namespace Unity.Collections
{
    public enum Allocator
    {
        None = 1,
        Temp = 2,
        TempJob = 3,
        Persistent = 4,
    }

    public enum NativeArrayOptions
    {
        UninitializedMemory = 0,
        ClearMemory = 1,
    }

    public unsafe struct NativeArray<T> : IDisposable where T : struct
    {
        internal IntPtr Memory;
        internal AtomicSafetyHandle Safety;
        internal bool Owned;

        public NativeArray(int length, Allocator allocator, NativeArrayOptions options = NativeArrayOptions.ClearMemory)
        {
            var bytes = length * Marshal.SizeOf(typeof(T));
            Memory = Marshal.AllocHGlobal(Math.Max(1, bytes));
            if (options == NativeArrayOptions.ClearMemory) for (var i = 0; i < bytes; i++) ((byte*)Memory)[i] = 0;
            Length = length;
            Owned = true;
            Safety = default(AtomicSafetyHandle);
        }

        public int Length { get; internal set; }
        public bool IsCreated => Memory != IntPtr.Zero;

        public T this[int index]
        {
            get
            {
                AtomicSafetyHandle.CheckReadAndThrow(Safety);
                if ((uint)index >= (uint)Length) throw new IndexOutOfRangeException();
                return (T)Marshal.PtrToStructure(new IntPtr((byte*)Memory + index * Marshal.SizeOf(typeof(T))), typeof(T));
            }
        }

        public void Dispose()
        {
            if (Owned) Marshal.FreeHGlobal(Memory);
            Memory = IntPtr.Zero;
            Length = 0;
        }
    }

    public unsafe struct NativeSlice<T> where T : struct
    {
        internal IntPtr Memory;
        internal AtomicSafetyHandle Safety;

        public int Length { get; internal set; }
        public int Stride { get; internal set; }

        public T this[int index]
        {
            get
            {
                AtomicSafetyHandle.CheckReadAndThrow(Safety);
                if ((uint)index >= (uint)Length) throw new IndexOutOfRangeException();
                return (T)Marshal.PtrToStructure(new IntPtr((byte*)Memory + index * Stride), typeof(T));
            }
        }
    }
}

namespace Unity.Collections.LowLevel.Unsafe
{
    /// <summary>0 is the handle of memory that nobody lends.</summary>
    public struct AtomicSafetyHandle
    {
        static readonly System.Collections.Generic.HashSet<int> Alive = new System.Collections.Generic.HashSet<int>();
        static int made;
        int number;

        public static AtomicSafetyHandle Create()
        {
            var handle = new AtomicSafetyHandle { number = ++made };
            Alive.Add(handle.number);
            return handle;
        }

        public static void CheckDeallocateAndThrow(AtomicSafetyHandle handle)
        {
            CheckReadAndThrow(handle);
        }

        public static void CheckReadAndThrow(AtomicSafetyHandle handle)
        {
            if (handle.number != 0 && !Alive.Contains(handle.number)) throw new ObjectDisposedException("the native array");
        }

        public static void Release(AtomicSafetyHandle handle)
        {
            Alive.Remove(handle.number);
        }
    }

    public static unsafe class NativeArrayUnsafeUtility
    {
        public static void* GetUnsafePtr<T>(this NativeArray<T> array) where T : struct
        {
            return (void*)array.Memory;
        }

        public static void* GetUnsafeReadOnlyPtr<T>(this NativeArray<T> array) where T : struct
        {
            return (void*)array.Memory;
        }

        public static NativeArray<T> ConvertExistingDataToNativeArray<T>(void* dataPointer, int length, Allocator allocator) where T : struct
        {
            return new NativeArray<T> { Memory = (IntPtr)dataPointer, Length = length };
        }

        public static void SetAtomicSafetyHandle<T>(ref NativeArray<T> array, AtomicSafetyHandle safety) where T : struct
        {
            array.Safety = safety;
        }
    }

    public static unsafe class NativeSliceUnsafeUtility
    {
        public static NativeSlice<T> ConvertExistingDataToNativeSlice<T>(void* dataPointer, int stride, int length) where T : struct
        {
            return new NativeSlice<T> { Memory = (IntPtr)dataPointer, Stride = stride, Length = length };
        }

        public static void SetAtomicSafetyHandle<T>(ref NativeSlice<T> slice, AtomicSafetyHandle safety) where T : struct
        {
            slice.Safety = safety;
        }
    }
}
