using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;
using Pbmpm;

/// <summary>Memory of the host that counts its blocks.</summary>
sealed class Blocks
{
    readonly Dictionary<IntPtr, IntPtr> starts = new Dictionary<IntPtr, IntPtr>();

    public int Living => starts.Count;

    public HostMemory Memory()
    {
        return new HostMemory(Allocate, Release);
    }

    IntPtr Allocate(long size, long alignment)
    {
        var start = Marshal.AllocHGlobal((IntPtr)(size + alignment));
        var block = (IntPtr)(((long)start + alignment - 1) / alignment * alignment);
        starts.Add(block, start);
        return block;
    }

    void Release(IntPtr block, long size)
    {
        Marshal.FreeHGlobal(starts[block]);
        starts.Remove(block);
    }
}
