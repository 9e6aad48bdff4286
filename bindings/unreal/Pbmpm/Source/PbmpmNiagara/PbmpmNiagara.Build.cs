// Particles for Niagara. A module of its own, so that a project without Niagara can leave it out.
using UnrealBuildTool;

public class PbmpmNiagara : ModuleRules
{
	public PbmpmNiagara(ReadOnlyTargetRules Target) : base(Target)
	{
		PCHUsage = PCHUsageMode.UseExplicitOrSharedPCHs;
		PublicDependencyModuleNames.AddRange(new string[] { "Core", "CoreUObject", "Engine", "PbmpmRuntime" });
		PrivateDependencyModuleNames.AddRange(new string[] { "Niagara" });
	}
}
