// Of Unity's types only what the binding uses, so that its part for Unity compiles and runs here.
using System;
using System.Runtime.InteropServices;

namespace UnityEngine
{
    public struct Vector3
    {
        public float x, y, z;

        public Vector3(float x, float y, float z)
        {
            this.x = x;
            this.y = y;
            this.z = z;
        }
    }
}

namespace AOT
{
    [AttributeUsage(AttributeTargets.Method)]
    public sealed class MonoPInvokeCallbackAttribute : Attribute
    {
        public MonoPInvokeCallbackAttribute(Type type)
        {
        }
    }
}

namespace Unity.Collections
{
    public enum Allocator
    {
        Temp = 2,
    }

    public struct NativeArray<T> : IDisposable where T : struct
    {
        readonly T[] elements;
        GCHandle pin;

        public NativeArray(int length, Allocator allocator) : this(new T[length], allocator)
        {
        }

        public NativeArray(T[] elements, Allocator allocator)
        {
            this.elements = (T[])elements.Clone();
            pin = GCHandle.Alloc(this.elements, GCHandleType.Pinned);
        }

        public bool IsCreated => elements != null;
        public int Length => elements.Length;
        public T this[int index] => elements[index];
        internal IntPtr Address => pin.AddrOfPinnedObject();

        public void Dispose()
        {
            pin.Free();
        }
    }
}

namespace Unity.Collections.LowLevel.Unsafe
{
    public static unsafe class NativeArrayUnsafeUtility
    {
        public static void* GetUnsafePtr<T>(this NativeArray<T> array) where T : struct
        {
            return (void*)array.Address;
        }

        public static void* GetUnsafeReadOnlyPtr<T>(this NativeArray<T> array) where T : struct
        {
            return (void*)array.Address;
        }
    }
}
