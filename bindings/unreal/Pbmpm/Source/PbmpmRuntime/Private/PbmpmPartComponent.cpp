#include "PbmpmPartComponent.h"

#include "Engine/StaticMesh.h"
#include "LandscapeProxy.h"
#include "StaticMeshResources.h"

#include "PbmpmSubsystem.h"
#include "PbmpmWorld.h"

using namespace PbmpmConversion;

static pbmpm::failure Refused(const char* Why)
{
	return {PBMPM_ERROR_INVALID_ARGUMENT, Why};
}

/* Asks a baking call for its size, bakes, and loads the solid into the world. */
template <class BakeType> static pbmpm::expected<pbmpm_baked_id> Load(FPbmpmWorld& World, const BakeType& Bake)
{
	const auto Size = Bake(pbmpm::span<std::byte>());
	if (!Size)
	{
		return Size.error();
	}
	std::vector<std::byte> Bytes(static_cast<SIZE_T>(*Size));
	if (const auto Baked = Bake(Bytes); !Baked)
	{
		return Baked.error();
	}
	const auto Matter = World.Editing();
	if (!Matter)
	{
		return Matter.error();
	}
	return Matter->baked_create(Bytes);
}

void UPbmpmPartComponent::BeginPlay()
{
	Super::BeginPlay();
	if (UPbmpmSubsystem* Subsystem = UPbmpmSubsystem::Of(*this))
	{
		Subsystem->Add(*this);
	}
}

void UPbmpmPartComponent::EndPlay(const EEndPlayReason::Type EndPlayReason)
{
	if (UPbmpmSubsystem* Subsystem = UPbmpmSubsystem::Of(*this))
	{
		Subsystem->Remove(*this);
	}
	Super::EndPlay(EndPlayReason);
}

pbmpm::expected<pbmpm::shape> UPbmpmPartComponent::MakeShape(FPbmpmWorld& World) const
{
	const FTransform& Place = GetComponentTransform();
	const FVector Scale = Place.GetScale3D();
	const pbmpm::vector3 Position = Plain(Place.GetLocation());
	const pbmpm::quaternion Rotation = Plain(Place.GetRotation());
	constexpr int UnrealUp = 2;
	switch (Shape)
	{
	case EPbmpmShape::Box:
		return Coordinates.box(Position, Rotation, Plain(HalfExtents * Scale));
	case EPbmpmShape::Sphere:
		return Coordinates.ball(Position, Radius * float(Scale.X));
	case EPbmpmShape::Capsule:
		return Coordinates.capsule(Position, Rotation, Radius * float(Scale.X), HalfLength * float(Scale.Z), UnrealUp);
	case EPbmpmShape::Plane:
		return Coordinates.plane(Position, Plain(Place.GetRotation().GetUpVector()));
	case EPbmpmShape::Mesh:
	{
		const auto Baked = BakeMesh(World);
		if (!Baked)
		{
			return Baked.error();
		}
		return Coordinates.baked(*Baked, Position, Rotation);
	}
	case EPbmpmShape::Landscape:
		return BakeLandscape(World);
	}
	return Refused("the shape is unknown");
}

void UPbmpmPartComponent::Pose(pbmpm::vector3& Position, pbmpm::quaternion& Rotation) const
{
	const FTransform& Place = GetComponentTransform();
	Position = Coordinates.vector(Plain(Place.GetLocation()));
	Rotation = Coordinates.rotation(Plain(Place.GetRotation()));
	if (Shape == EPbmpmShape::Capsule)
	{
		constexpr int UnrealUp = 2;
		Rotation = Coordinates.capsule_rotation(Plain(Place.GetRotation()), UnrealUp);
	}
}

pbmpm::expected<pbmpm_baked_id> UPbmpmPartComponent::BakeMesh(FPbmpmWorld& World) const
{
	if (!Mesh || !Mesh->bAllowCPUAccess || !Mesh->GetRenderData() || Mesh->GetRenderData()->LODResources.Num() == 0)
	{
		return Refused("the shape is a mesh, and there is none with CPU access (a setting of the static mesh)");
	}
	const FStaticMeshLODResources& Finest = Mesh->GetRenderData()->LODResources[0];
	const FPositionVertexBuffer& Corners = Finest.VertexBuffers.PositionVertexBuffer;
	const FIndexArrayView Triangles = Finest.IndexBuffer.GetArrayView();
	const FVector Scale = GetComponentTransform().GetScale3D();
	std::vector<float> Vertices;
	std::vector<uint32_t> Elements;
	for (uint32 Index = 0; Index < Corners.GetNumVertices(); Index++)
	{
		const FVector3f& Corner = Corners.VertexPosition(Index);
		const pbmpm::vector3 There = Coordinates.vector(Plain(FVector(Corner.X, Corner.Y, Corner.Z) * Scale));
		Vertices.insert(Vertices.end(), There.begin(), There.end());
	}
	for (int32 Index = 0; Index < Triangles.Num(); Index++)
	{
		Elements.push_back(Triangles[Index]);
	}
	pbmpm::mesh_def Def;
	Def.vertices = Vertices.data();
	Def.vertex_count = Corners.GetNumVertices();
	Def.elements = Elements.data();
	Def.element_count = uint32(Elements.size() / 3);
	Def.resolution = Resolution;
	return Load(World, [&Def](pbmpm::span<std::byte> Buffer) { return pbmpm::bake_mesh(Def, Buffer); });
}

/* Heights over the XY square of the component's box; the world has them along its second axis. Where the landscape has none the box's floor stands in. */
pbmpm::expected<pbmpm::shape> UPbmpmPartComponent::BakeLandscape(FPbmpmWorld& World) const
{
	if (!Landscape || !(HeightSpacing > 0.0f))
	{
		return Refused("the shape is a landscape, and there is none");
	}
	const FTransform& Place = GetComponentTransform();
	const FVector Half = HalfExtents * Place.GetScale3D();
	const FVector Corner = Place.GetLocation() - Half;
	const int32 Columns = FMath::Max(2, int32(2.0 * Half.X / HeightSpacing) + 1), Rows = FMath::Max(2, int32(2.0 * Half.Y / HeightSpacing) + 1);
	std::vector<float> Heights;
	for (int32 Row = 0; Row < Rows; Row++)
	{
		for (int32 Column = 0; Column < Columns; Column++)
		{
			const FVector There(Corner.X + Column * HeightSpacing, Corner.Y + Row * HeightSpacing, Corner.Z);
			const TOptional<float> Height = Landscape->GetHeightAtLocation(There);
			Heights.push_back(Height.IsSet() ? Coordinates.length(Height.GetValue() - float(Corner.Z)) : 0.0f);
		}
	}
	pbmpm::heights_def Def;
	Def.heights = Heights.data();
	Def.count[0] = uint32(Columns);
	Def.count[1] = uint32(Rows);
	Def.spacing[0] = Def.spacing[1] = Coordinates.length(HeightSpacing);
	Def.thickness = Coordinates.length(float(2.0 * Half.Z));
	const auto Baked = Load(World, [&Def](pbmpm::span<std::byte> Buffer) { return pbmpm::bake_heights(Def, Buffer); });
	if (!Baked)
	{
		return Baked.error();
	}
	return Coordinates.baked(*Baked, Plain(Corner), {0, 0, 0, 1});
}
