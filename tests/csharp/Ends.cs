using System;
using Pbmpm;

/// <summary>How a process ends: Ends.exe throw, with a function of the host that throws; Ends.exe leave, with a world left.</summary>
static class Ends
{
    static World kept;

    static void Main(string[] arguments)
    {
        var blocks = new Blocks();
        if (arguments[0] == "throw") Library.Log = (level, line) => throw new InvalidOperationException("thrown by the host");
        kept = new World(WorldDef.Default, null, blocks.Memory());
        Console.WriteLine("blocks of a world: {0}", blocks.Living);
        AppDomain.CurrentDomain.ProcessExit += (sender, nothing) => Console.WriteLine("blocks at the end: {0}", blocks.Living);
        if (arguments[0] == "throw") kept.Step(-1);
    }
}
