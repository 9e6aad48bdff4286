#if !UNITY_5_3_OR_NEWER
using System;

namespace AOT
{
    /// <summary>Marks what native code calls, for compilers that make all code ahead; they know it by its name. Unity brings its
    /// own.</summary>
    [AttributeUsage(AttributeTargets.Method)]
    internal sealed class MonoPInvokeCallbackAttribute : Attribute
    {
        public MonoPInvokeCallbackAttribute(Type type)
        {
        }
    }
}
#endif
