// Of NUnit and Unity's test framework only what the package's tests use.
using System;
using System.Collections.Generic;
using System.Text.RegularExpressions;

namespace UnityEngine
{
    public enum LogType
    {
        Error = 0,
        Warning = 2,
        Exception = 4,
    }
}

namespace UnityEngine.TestTools
{
    [AttributeUsage(AttributeTargets.Method)]
    public sealed class UnityTestAttribute : Attribute
    {
    }

    public static class LogAssert
    {
        public static readonly List<Regex> Expected = new List<Regex>();

        public static void Expect(LogType type, Regex message)
        {
            Expected.Add(message);
        }
    }
}

namespace NUnit.Framework
{
    [AttributeUsage(AttributeTargets.Method)]
    public sealed class TestAttribute : Attribute
    {
    }

    [AttributeUsage(AttributeTargets.Method)]
    public sealed class SetUpAttribute : Attribute
    {
    }

    [AttributeUsage(AttributeTargets.Method)]
    public sealed class TearDownAttribute : Attribute
    {
    }

    public sealed class AssertionException : Exception
    {
        public AssertionException(string message) : base(message)
        {
        }
    }

    public delegate void TestDelegate();

    public static class Assert
    {
        public static void AreEqual(object expected, object actual)
        {
            if (expected is int && actual is double) expected = (double)(int)expected;
            Require(Equals(expected, actual), "expected " + expected + ", got " + actual);
        }

        public static void AreEqual(double expected, double actual, double delta)
        {
            Require(Math.Abs(expected - actual) <= delta, "expected " + expected + " +- " + delta + ", got " + actual);
        }

        public static void IsTrue(bool condition)
        {
            Require(condition, "expected true");
        }

        public static void Greater(double arg1, double arg2)
        {
            Require(arg1 > arg2, "expected above " + arg2 + ", got " + arg1);
        }

        public static void Less(double arg1, double arg2, string message = "")
        {
            Require(arg1 < arg2, "expected below " + arg2 + ", got " + arg1 + " " + message);
        }

        public static T Throws<T>(TestDelegate code) where T : Exception
        {
            try
            {
                code();
            }
            catch (T problem)
            {
                return problem;
            }
            throw new AssertionException("expected " + typeof(T).Name);
        }

        static void Require(bool holds, string message)
        {
            if (!holds) throw new AssertionException(message);
        }
    }
}
