using System;
using Pbmpm;

/// <summary>Compiled with declarations that were spoilt on purpose: WrongMirror.exe TEXT succeeds when the library is refused
/// with a message that holds the text.</summary>
static class WrongMirror
{
    static int Main(string[] arguments)
    {
        try
        {
            new World(default(WorldDef));
        }
        catch (LibraryException problem) when (problem.Message.Contains(arguments[0]))
        {
            Console.WriteLine("refused as it should be: " + problem.Message);
            return 0;
        }
        catch (Exception problem)
        {
            Console.WriteLine("expected a refusal that says '" + arguments[0] + "', got: " + problem.Message);
            return 1;
        }
        Console.WriteLine("the library was not refused");
        return 1;
    }
}
