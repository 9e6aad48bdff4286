#pragma once
#include "CoreMinimal.h"
class FPositionVertexBuffer
{
public:
	uint32 GetNumVertices() const { return uint32(Stub.size()); }
	const FVector3f& VertexPosition(uint32 Index) const { return Stub[Index]; }
	std::vector<FVector3f> Stub;
};
struct FStaticMeshVertexBuffers
{
	FPositionVertexBuffer PositionVertexBuffer;
};
class FIndexArrayView
{
public:
	explicit FIndexArrayView(const std::vector<uint32>& In) : It(In) {}
	uint32 operator[](int32 Index) const { return It[SIZE_T(Index)]; }
	int32 Num() const { return int32(It.size()); }

private:
	const std::vector<uint32>& It;
};
class FRawStaticIndexBuffer
{
public:
	FIndexArrayView GetArrayView() const { return FIndexArrayView(Stub); }
	std::vector<uint32> Stub;
};
struct FStaticMeshLODResources
{
	FStaticMeshVertexBuffers VertexBuffers;
	FRawStaticIndexBuffer IndexBuffer;
};
class FStaticMeshRenderData
{
public:
	TArray<FStaticMeshLODResources> LODResources;
};
