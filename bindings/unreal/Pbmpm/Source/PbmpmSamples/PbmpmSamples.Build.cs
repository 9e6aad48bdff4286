// Three actors to drop into a level.
using UnrealBuildTool;

public class PbmpmSamples : ModuleRules
{
	public PbmpmSamples(ReadOnlyTargetRules Target) : base(Target)
	{
		PCHUsage = PCHUsageMode.UseExplicitOrSharedPCHs;
		PublicDependencyModuleNames.AddRange(new string[] { "Core", "CoreUObject", "Engine", "PbmpmRuntime" });
	}
}
