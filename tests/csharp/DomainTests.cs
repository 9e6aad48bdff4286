using System;
using System.Collections.Generic;
using Pbmpm;

/// <summary>A domain that is unloaded takes its worlds with it, as in Unity's editor with each compilation.</summary>
static class DomainTests
{
    const string Left = "blocks that were left";

    static World Kept { get; set; }
    static readonly List<string> Lines = new List<string>();
    static readonly Blocks Lent = new Blocks();

    [Test]
    static void AnUnloadedDomainTakesItsWorldsWithIt()
    {
        var refusals = new List<string>();
        Library.Log = (level, line) => { if (level == LogLevel.Error) refusals.Add(line); }; // a world that were destroyed twice would be a refused call
        for (var round = 0; round < 5; round++)
        {
            var domain = AppDomain.CreateDomain("of a round", null, AppDomain.CurrentDomain.SetupInformation);
            domain.SetData(Left, new Report());
            domain.DoCallBack(LeaveWorlds);
            var report = (Report)domain.GetData(Left);
            Expect.True(report.Before > 0, "a world of the domain is in its memory");
            AppDomain.Unload(domain);
        }
        GC.Collect();
        GC.WaitForPendingFinalizers();
        Library.Log = null;
        Expect.Equal("", string.Join("; ", refusals), "refused calls");
        foreach (var after in Report.After) Expect.Equal(0, after, "blocks of its worlds at the end of a domain");
        Expect.Equal(5, Report.After.Count, "domains that ended");
    }

    [Test]
    static void AnUnloadedDomainTakesItsLogWithIt()
    {
        var domain = AppDomain.CreateDomain("with a log", null, AppDomain.CurrentDomain.SetupInformation);
        domain.DoCallBack(KeepALog);
        AppDomain.Unload(domain);
        using (var world = Scenes.Box(2))
            Expect.Refused(Result.ErrorInvalidArgument, () => world.Step(-1), "what the log would tell of");
    }

    static void KeepALog()
    {
        Library.Log = (level, line) => Lines.Add(line);
    }

    /// <summary>Runs in the other domain: worlds that nobody disposes of, one of them with memory of that domain. Together they are
    /// more than a process may have.</summary>
    static void LeaveWorlds()
    {
        Kept = new World(Scenes.Box(2).Definition, null, Lent.Memory());
        for (var i = 0; i < Constants.MaxWorlds / 4; i++) Scenes.Box(2, capacity: 1);
        var report = (Report)AppDomain.CurrentDomain.GetData(Left);
        report.Before = Lent.Living;
        AppDomain.CurrentDomain.DomainUnload += (sender, nothing) => report.Note(Lent.Living);
    }

    /// <summary>Lives in the domain of the tests.</summary>
    sealed class Report : MarshalByRefObject
    {
        public static readonly List<int> After = new List<int>();

        public int Before { get; set; }

        public void Note(int blocks)
        {
            After.Add(blocks);
        }
    }
}
