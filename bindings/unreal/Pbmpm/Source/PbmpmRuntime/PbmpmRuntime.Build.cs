// The plugin's components. The module is not named Pbmpm: its macro PBMPM_API would be the library's.
using UnrealBuildTool;

public class PbmpmRuntime : ModuleRules
{
	public PbmpmRuntime(ReadOnlyTargetRules Target) : base(Target)
	{
		PCHUsage = PCHUsageMode.UseExplicitOrSharedPCHs;
		PublicDependencyModuleNames.AddRange(new string[] { "Core", "CoreUObject", "Engine", "PbmpmLibrary" });
		PrivateDependencyModuleNames.AddRange(new string[] { "Landscape", "Projects", "RenderCore" });
	}
}
