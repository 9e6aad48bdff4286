using System;
using System.Collections.Generic;
using System.Text;
using Pbmpm.Native;

namespace Pbmpm
{
    /// <summary>The native library as a whole.</summary>
    public static unsafe partial class Library
    {
        static volatile bool fits;

        /// <summary>The version of the library that is loaded, as major * 1000000 + minor * 1000 + patch.</summary>
        public static uint Version
        {
            get
            {
                Check();
                return Methods.pbmpm_version();
            }
        }

        /// <summary>The kernels in use. The environment variable PBMPM_ISA may lower the choice.</summary>
        public static Isa ActiveIsa
        {
            get
            {
                Check();
                return Methods.pbmpm_active_isa();
            }
        }

        /// <summary>Whether this is a strict build (PBMPM_STRICT): the same results with every instruction set, bit for bit.</summary>
        public static bool IsStrict
        {
            get
            {
                Check();
                return Methods.pbmpm_build_is_strict() != 0;
            }
        }

        /// <summary>The name of an instruction set ("AVX2").</summary>
        public static string NameOf(Isa isa)
        {
            Check();
            return Text(Methods.pbmpm_isa_name(isa));
        }

        /// <summary>Whether the library was built with materials of a kind; creating one of another kind is refused.</summary>
        public static bool Builds(MaterialKind kind)
        {
            Check();
            return (int)kind >= 0 && (int)kind < 32 && (Methods.pbmpm_materials_built() >> (int)kind & 1) != 0;
        }

        /// <summary>Compares version and ABI number, and the place and size of every field, with what the library says
        /// about itself. Everything else in this namespace calls it first, so that a library that does not fit is refused
        /// instead of corrupting memory. Costs nothing after the first success.</summary>
        /// <exception cref="LibraryException">The library is missing or does not fit; the message says why.</exception>
        public static void Check()
        {
            if (fits) return;
            try
            {
                CheckVersion();
                CheckLayout();
            }
            catch (Exception cause) when (cause is DllNotFoundException || cause is EntryPointNotFoundException
                                          || cause is BadImageFormatException)
            {
                throw new LibraryException("the native library '" + Methods.LibraryName + "' cannot be loaded; it has to stand "
                    + "beside the program or on the system's search path, and to be of the same architecture: "
                    + cause.Message, cause);
            }
            fits = true;
        }

        /// <summary>Destroys all worlds and joins all threads of the library, for hosts that unload it. No other call may be
        /// under way. World objects that are left are dead; disposing of them does nothing.</summary>
        public static void Shutdown()
        {
            Check();
            Require(Methods.pbmpm_shutdown());
        }

        /// <summary>Throws unless the call went well. For use with <see cref="Methods"/>; to be called on the thread of
        /// the call.</summary>
        /// <exception cref="PbmpmException">The result is not <see cref="Result.Ok"/>.</exception>
        public static void Require(Result result)
        {
            if (result != Result.Ok) throw Problem(result);
        }

        internal static PbmpmException Problem(Result result)
        {
            return new PbmpmException(result, Text(Methods.pbmpm_result_name(result)), Text(Methods.pbmpm_last_error()));
        }

        /// <summary>A copy of a text of the library, which is UTF-8 that ends with a zero.</summary>
        public static string Text(IntPtr text)
        {
            var begin = (byte*)text;
            if (begin == null) return "";
            var end = begin;
            while (*end != 0) end++;
            return Encoding.UTF8.GetString(begin, (int)(end - begin));
        }

        static void CheckVersion()
        {
            var abi = Methods.pbmpm_abi_version();
            if (abi != Constants.AbiVersion)
                throw new LibraryException("this assembly needs ABI " + Constants.AbiVersion
                    + ", but the native library has ABI " + abi);
            var needed = Constants.VersionMajor * 1000000u + Constants.VersionMinor * 1000u + Constants.VersionPatch;
            var version = Methods.pbmpm_version();
            if (version < needed)
                throw new LibraryException("this assembly needs version " + VersionText(needed)
                    + " or later, but the native library is " + VersionText(version));
        }

        static string VersionText(uint version)
        {
            return version / 1000000 + "." + version / 1000 % 1000 + "." + version % 1000;
        }

        static void CheckLayout()
        {
            LayoutEntry* entries;
            uint count;
            Require(Methods.pbmpm_layout_table(&entries, &count));
            var theirs = new Dictionary<string, LayoutEntry>((int)count);
            for (uint i = 0; i < count; i++)
                theirs[Text(entries[i].Structure) + "." + Text(entries[i].Field)] = entries[i];
            foreach (var mine in Mirror.All())
            {
                var known = theirs.TryGetValue(mine.Structure + "." + mine.Field, out var found);
                if (known && mine.Fits(found.Offset, found.Size)) continue;
                var has = known ? "has it at offset " + found.Offset + " with " + found.Size + " bytes" : "does not have it";
                throw new LibraryException("the native library does not fit this assembly: " + mine.Name + " should be at offset "
                    + mine.Offset + " with " + mine.Size + " bytes, but the library " + has + "; use both of one version");
            }
        }
    }
}
