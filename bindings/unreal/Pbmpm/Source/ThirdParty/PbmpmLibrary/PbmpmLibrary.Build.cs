// The library, its headers and those of the layer for engines. packaging/unreal.sh puts them here and into Binaries.
using System.IO;
using UnrealBuildTool;

public class PbmpmLibrary : ModuleRules
{
	public PbmpmLibrary(ReadOnlyTargetRules Target) : base(Target)
	{
		Type = ModuleType.External;
		PublicSystemIncludePaths.Add(Path.Combine(ModuleDirectory, "include"));

		string Binaries = Path.Combine(PluginDirectory, "Binaries", "ThirdParty", "PbmpmLibrary");
		if (Target.Platform == UnrealTargetPlatform.Win64)
		{
			PublicAdditionalLibraries.Add(Path.Combine(ModuleDirectory, "lib", "Win64", "pbmpm.lib"));
			// The runtime module loads it, and says why where it cannot.
			PublicDelayLoadDLLs.Add("pbmpm.dll");
			RuntimeDependencies.Add("$(PluginDir)/Binaries/ThirdParty/PbmpmLibrary/Win64/pbmpm.dll");
		}
		else if (Target.Platform == UnrealTargetPlatform.Linux)
		{
			string Library = Path.Combine(Binaries, "Linux", "libpbmpm.so.1");
			PublicAdditionalLibraries.Add(Library);
			PublicDelayLoadDLLs.Add(Library);
			RuntimeDependencies.Add("$(PluginDir)/Binaries/ThirdParty/PbmpmLibrary/Linux/libpbmpm.so.1");
		}
		else
		{
			throw new BuildException("pbmpm has no library for " + Target.Platform);
		}
	}
}
