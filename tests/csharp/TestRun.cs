using System;
using System.Collections.Generic;
using System.Reflection;

/// <summary>A static method that is a test. It fails by throwing.</summary>
[AttributeUsage(AttributeTargets.Method)]
sealed class TestAttribute : Attribute
{
}

sealed class FailedTest : Exception
{
    public FailedTest(string message) : base(message)
    {
    }
}

static class Expect
{
    public static void Equal<T>(T expected, T actual, string what)
    {
        if (!EqualityComparer<T>.Default.Equals(expected, actual))
            throw new FailedTest(what + " is " + actual + " instead of " + expected);
    }

    public static void Near(double expected, double actual, double tolerance, string what)
    {
        if (!(Math.Abs(expected - actual) <= tolerance)) throw new FailedTest(what + " is " + actual + " instead of " + expected);
    }

    public static void True(bool condition, string what)
    {
        if (!condition) throw new FailedTest("not so: " + what);
    }

    /// <summary>The exception of this type that the action throws.</summary>
    public static T Throws<T>(Action action, string what) where T : Exception
    {
        try
        {
            action();
        }
        catch (T expected)
        {
            return expected;
        }
        throw new FailedTest(what + " did not throw " + typeof(T).Name);
    }

    public static void Refused(Pbmpm.Result result, Action action, string what)
    {
        Equal(result, Throws<Pbmpm.PbmpmException>(action, what).Result, "the result of " + what);
    }
}

/// <summary>Runs all tests of the program and prints a summary in the form of the C tests.</summary>
static class TestRun
{
    static int Main()
    {
        int count = 0, failures = 0;
        foreach (var type in Assembly.GetExecutingAssembly().GetTypes())
        {
            foreach (var method in type.GetMethods(BindingFlags.Static | BindingFlags.NonPublic | BindingFlags.Public))
            {
                if (!method.IsDefined(typeof(TestAttribute), false)) continue;
                count++;
                if (!Passes(method)) failures++;
            }
        }
        Console.WriteLine("-----------------------\n{0} Tests {1} Failures 0 Ignored", count, failures);
        return failures == 0 ? 0 : 1;
    }

    static bool Passes(MethodInfo method)
    {
        var name = method.DeclaringType.Name + "." + method.Name;
        try
        {
            ((Action)Delegate.CreateDelegate(typeof(Action), method))();
        }
        catch (Exception problem)
        {
            Console.WriteLine("{0}:FAIL: {1}", name, problem);
            return false;
        }
        Console.WriteLine("{0}:PASS", name);
        return true;
    }
}
