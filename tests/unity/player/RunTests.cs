using System;
using System.Collections;
using System.Linq;
using System.Reflection;
using NUnit.Framework;
using UnityEngine;
using UnityEngine.TestTools;

/// <summary>Runs the package's tests as Unity's runner would: RunTests.exe [NAME]; those of the editor while nothing plays.</summary>
static class RunTests
{
    static int failed, passed;

    static int Main(string[] words)
    {
        var wanted = words.Length > 0 ? words[0] : "";
        Run(Assembly.Load("Pbmpm.Tests.Editor"), wanted);
        Player.Play(Assembly.Load("Pbmpm.Components"));
        Run(Assembly.Load("Pbmpm.Tests"), wanted);
        Player.Stop();
        Console.WriteLine(passed + " passed, " + failed + " failed");
        return failed > 0 || passed == 0 ? 1 : 0;
    }

    static void Run(Assembly assembly, string wanted)
    {
        foreach (var kind in assembly.GetTypes())
            foreach (var method in kind.GetMethods().Where(IsTest))
                if (method.Name.Contains(wanted))
                    Count(kind.Name + "." + method.Name, Problem(kind, method));
    }

    static bool IsTest(MethodInfo method)
    {
        return Has<TestAttribute>(method) || Has<UnityTestAttribute>(method);
    }

    static bool Has<T>(MethodInfo method) where T : Attribute
    {
        return method.GetCustomAttributes(typeof(T), false).Length > 0;
    }

    static void Count(string name, string problem)
    {
        if (problem == null) passed++;
        else failed++;
        Console.WriteLine((problem == null ? "ok      " : "FAILED  ") + name + (problem == null ? "" : ": " + problem));
    }

    static string Problem(Type kind, MethodInfo test)
    {
        Debug.Told.Clear();
        LogAssert.Expected.Clear();
        var fixture = Activator.CreateInstance(kind);
        try
        {
            Call<SetUpAttribute>(fixture);
            try
            {
                var frames = test.Invoke(fixture, null) as IEnumerator;
                while (frames != null && frames.MoveNext()) Player.Frame(1 / 60f);
            }
            finally
            {
                Call<TearDownAttribute>(fixture);
            }
            return Untold();
        }
        catch (Exception problem)
        {
            return problem is TargetInvocationException ? problem.InnerException.ToString() : problem.ToString();
        }
    }

    static void Call<T>(object fixture) where T : Attribute
    {
        foreach (var method in fixture.GetType().GetMethods().Where(Has<T>)) method.Invoke(fixture, null);
    }

    /// <summary>Each line of the log has to be expected, and each that is has to come.</summary>
    static string Untold()
    {
        var expected = LogAssert.Expected;
        if (Debug.Told.Count != expected.Count) return "told: " + string.Join("; ", Debug.Told.ToArray());
        for (var i = 0; i < expected.Count; i++)
            if (!expected[i].IsMatch(Debug.Told[i]))
                return "told: " + Debug.Told[i];
        return null;
    }
}
