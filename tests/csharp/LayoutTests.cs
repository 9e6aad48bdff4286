using System;
using System.Collections.Generic;
using System.Linq;
using System.Reflection;
using System.Runtime.InteropServices;
using Pbmpm;
using Pbmpm.Native;

/// <summary>The mirrored structures look the same to the compiler, to the marshaller and to the library.</summary>
static class LayoutTests
{
    static Type TypeOf(string structure)
    {
        var name = string.Concat(structure.Split('_').Skip(1).Select(word => char.ToUpperInvariant(word[0]) + word.Substring(1)));
        return Assembly.GetExecutingAssembly().GetTypes().Single(type => type.IsValueType && !type.IsEnum && type.IsPublic && type.Name == name);
    }

    [Test]
    static void TheLibraryFits()
    {
        Library.Check();
        Expect.Equal((uint)Constants.VersionMajor, Library.Version / 1000000, "the major version");
        Expect.True(Library.ActiveIsa != Isa.None, "the CPU is supported");
        Expect.True(Library.NameOf(Library.ActiveIsa).Length > 0, "the kernels have a name");
    }

    [Test]
    static void TheMarshallerAgreesWithTheCompiler()
    {
        var structures = Mirror.All().GroupBy(field => field.Structure).ToList();
        Expect.True(structures.Count > 10, "there are structures");
        foreach (var structure in structures)
        {
            var type = TypeOf(structure.Key);
            Expect.Equal((int)structure.Last().Size, Marshal.SizeOf(type), "size of " + type.Name);
            var fields = type.GetFields(BindingFlags.Instance | BindingFlags.Public).OrderBy(it => it.MetadataToken).ToList();
            Expect.Equal(fields.Count, structure.Count() - 1, "number of fields of " + type.Name);
            foreach (var pair in fields.Zip(structure, (field, mirror) => new { field.Name, mirror }))
                Expect.Equal((int)pair.mirror.Offset, (int)Marshal.OffsetOf(type, pair.Name), "offset of " + pair.mirror.Name);
        }
    }

    [Test]
    static unsafe void NoStructureOfTheLibraryIsMissing()
    {
        LayoutEntry* entries;
        uint count;
        Library.Require(Methods.pbmpm_layout_table(&entries, &count));
        var mine = Mirror.All().Select(field => field.Structure + "." + field.Field).ToList();
        var theirs = new List<string>();
        for (uint i = 0; i < count; i++)
            theirs.Add(Library.Text(entries[i].Structure) + "." + Library.Text(entries[i].Field));
        Expect.Equal("", string.Join(" ", theirs.Except(mine)), "what only the library has");
        Expect.Equal("", string.Join(" ", mine.Except(theirs)), "what only the binding has");
    }

    [Test]
    static unsafe void OnlyAStructureWithASizeMayGrow()
    {
        ulong room;
        var start = (byte*)&room;
        var versioned = new MirrorField("s", "", start, start, start + 8, true);
        Expect.True(versioned.Fits(0, 8) && versioned.Fits(0, 12), "a newer library may have appended fields");
        Expect.True(!versioned.Fits(0, 4) && !versioned.Fits(4, 8), "nothing may be missing or have moved");
        var plain = new MirrorField("s", "f", start, start + 2, start + 4, false);
        Expect.True(plain.Fits(2, 2), "equal fields fit");
        Expect.True(!plain.Fits(2, 4) && !plain.Fits(0, 2), "a field that grew or moved does not fit");
    }
}
