// A stand-in for Unreal's header of this name, written from its public documentation: what the plugin uses of it, with the behaviour that the test needs. So are the
// others in this folder.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <unordered_map>
#include <utility>
#include <vector>

using int32 = std::int32_t;
using uint32 = std::uint32_t;
using int64 = std::int64_t;
using uint8 = std::uint8_t;
using SIZE_T = std::size_t;
using TCHAR = char16_t;

#define TEXT(Text) u##Text
#define PLATFORM_WINDOWS 0
#define INDEX_NONE (-1)
#define PI 3.14159265f
#define THIRD_PARTY_INCLUDES_START
#define THIRD_PARTY_INCLUDES_END

#define UCLASS(...)
#define USTRUCT(...)
#define UENUM(...)
#define UPROPERTY(...)
#define UFUNCTION(...)
// Each header's generated file defines what stands for GENERATED_BODY() at each line, as Unreal's header tool does.
#define STUB_JOIN_NOW(A, B, C) A##B##C
#define STUB_JOIN(A, B, C) STUB_JOIN_NOW(A, B, C)
#define GENERATED_BODY(...) STUB_JOIN(CURRENT_FILE_ID, _, __LINE__)

class FString
{
public:
	FString() = default;
	FString(const TCHAR* Text) : It(Text) {}
	FString(std::u16string Text) : It(std::move(Text)) {}
	const TCHAR* operator*() const { return It.c_str(); }
	FString& operator+=(const FString& Other) { It += Other.It; return *this; }
	bool IsEmpty() const { return It.empty(); }
	bool Contains(const TCHAR* Part) const { return It.find(Part) != std::u16string::npos; }

	template <class... Types> static FString Printf(const TCHAR* Format, const Types&... Values)
	{
		std::u16string Result, Rest = Format;
		(Put(Result, Rest, Values), ...);
		return Result + Rest;
	}

private:
	static std::u16string Shown(const TCHAR* Text) { return Text; }
	template <class NumberType> static std::u16string Shown(NumberType Number)
	{
		const std::string Narrow = std::to_string(Number);
		return std::u16string(Narrow.begin(), Narrow.end());
	}
	template <class Type> static void Put(std::u16string& Result, std::u16string& Rest, const Type& Value)
	{
		const SIZE_T At = Rest.find(u'%');
		Result += Rest.substr(0, At) + Shown(Value);
		Rest = Rest.substr(At + 2);
	}
	std::u16string It;
};

class FName
{
public:
	FName() = default;
	FName(const TCHAR* Text) : It(Text) {}
	bool operator==(const FName& Other) const { return It == Other.It; }
	std::u16string It;
};

// Valid until the end of the full expression in Unreal; here for longer.
inline const TCHAR* StubTchars(const char* Text)
{
	static std::u16string Kept[8];
	static int Next = 0;
	std::u16string& It = Kept[Next++ % 8];
	It.assign(Text, Text + std::strlen(Text));
	return It.c_str();
}
#define UTF8_TO_TCHAR(Text) StubTchars(Text)

inline const FName NAME_None;

struct FStubLog
{
	static FStubLog& Get()
	{
		static FStubLog It;
		return It;
	}
	int Errors = 0, Warnings = 0;
	FString Last;
};
namespace StubVerbosity
{
enum Type { Error, Warning, Display, Log };
}
inline void StubLog(StubVerbosity::Type Verbosity, const FString& Line)
{
	FStubLog& Log = FStubLog::Get();
	Log.Errors += Verbosity == StubVerbosity::Error;
	Log.Warnings += Verbosity == StubVerbosity::Warning;
	Log.Last = Line;
}
#define DECLARE_LOG_CATEGORY_EXTERN(Name, Default, Compiled) struct FStub##Name {}; extern FStub##Name Name
#define DEFINE_LOG_CATEGORY(Name) FStub##Name Name
#define UE_LOG(Name, Verbosity, ...) (static_cast<void>(Name), StubLog(StubVerbosity::Verbosity, FString::Printf(__VA_ARGS__)))

struct FMath
{
	template <class Type> static Type Min(Type A, Type B) { return std::min(A, B); }
	template <class Type> static Type Max(Type A, Type B) { return std::max(A, B); }
	static float DegreesToRadians(float Degrees) { return Degrees * 3.14159265f / 180.0f; }
};
struct FMemory
{
	static int32 Memcmp(const void* A, const void* B, SIZE_T Count) { return std::memcmp(A, B, Count); }
};

struct FVector3f
{
	float X, Y, Z;
};
struct FVector
{
	double X = 0, Y = 0, Z = 0;
	FVector() = default;
	explicit FVector(double All) : X(All), Y(All), Z(All) {}
	FVector(double InX, double InY, double InZ) : X(InX), Y(InY), Z(InZ) {}
	FVector operator+(const FVector& V) const { return FVector(X + V.X, Y + V.Y, Z + V.Z); }
	FVector operator-(const FVector& V) const { return FVector(X - V.X, Y - V.Y, Z - V.Z); }
	FVector operator*(const FVector& V) const { return FVector(X * V.X, Y * V.Y, Z * V.Z); }
	FVector operator*(double Scale) const { return FVector(X * Scale, Y * Scale, Z * Scale); }
	static FVector CrossProduct(const FVector& A, const FVector& B) { return FVector(A.Y * B.Z - A.Z * B.Y, A.Z * B.X - A.X * B.Z, A.X * B.Y - A.Y * B.X); }
	static const FVector ZeroVector, ForwardVector;
};
inline const FVector FVector::ZeroVector, FVector::ForwardVector{1, 0, 0};
struct FQuat
{
	double X = 0, Y = 0, Z = 0, W = 1;
	FQuat() = default;
	FQuat(double InX, double InY, double InZ, double InW) : X(InX), Y(InY), Z(InZ), W(InW) {}
	FQuat(const FVector& Axis, double Angle) : X(Axis.X * std::sin(Angle / 2)), Y(Axis.Y * std::sin(Angle / 2)), Z(Axis.Z * std::sin(Angle / 2)), W(std::cos(Angle / 2)) {}
	FQuat operator*(const FQuat& Q) const
	{
		const FVector U(X, Y, Z), V(Q.X, Q.Y, Q.Z), S = V * W + U * Q.W + FVector::CrossProduct(U, V);
		return FQuat(S.X, S.Y, S.Z, W * Q.W - X * Q.X - Y * Q.Y - Z * Q.Z);
	}
	FVector RotateVector(const FVector& V) const
	{
		const FVector U(X, Y, Z), Across = FVector::CrossProduct(U, V);
		return V + Across * (2 * W) + FVector::CrossProduct(U, Across) * 2;
	}
	FVector GetForwardVector() const { return RotateVector(FVector(1, 0, 0)); }
	FVector GetUpVector() const { return RotateVector(FVector(0, 0, 1)); }
	static const FQuat Identity;
};
inline const FQuat FQuat::Identity;
class FTransform
{
public:
	FTransform() = default;
	FTransform(const FQuat& InRotation, const FVector& InLocation, const FVector& InScale) : Rotation(InRotation), Location(InLocation), Scale(InScale) {}
	FQuat GetRotation() const { return Rotation; }
	FVector GetLocation() const { return Location; }
	FVector GetScale3D() const { return Scale; }
	void SetScale3D(const FVector& InScale) { Scale = InScale; }

private:
	FQuat Rotation;
	FVector Location, Scale{1, 1, 1};
};
struct FLinearColor
{
	float R = 0, G = 0, B = 0, A = 1;
	FLinearColor(float InR, float InG, float InB, float InA = 1) : R(InR), G(InG), B(InB), A(InA) {}
	static const FLinearColor White;
};
inline const FLinearColor FLinearColor::White{1, 1, 1};

template <class Type> class TArray
{
public:
	int32 Num() const { return int32(It.size()); }
	void Add(Type Value) { It.push_back(std::move(Value)); }
	void Reserve(int32 Count) { It.reserve(SIZE_T(Count)); }
	void SetNum(int32 Count) { It.resize(SIZE_T(Count)); }
	void RemoveAt(int32 Index) { It.erase(It.begin() + Index); }
	int32 Find(const Type& Value) const
	{
		const auto At = std::find(It.begin(), It.end(), Value);
		return At == It.end() ? INDEX_NONE : int32(At - It.begin());
	}
	// Unreal's takes references where the elements are pointers.
	template <class PredicateType> void StableSort(PredicateType Before)
	{
		std::stable_sort(It.begin(), It.end(), [&](const Type& A, const Type& B) { return Before(*A, *B); });
	}
	Type& operator[](int32 Index) { return It.at(SIZE_T(Index)); }
	const Type& operator[](int32 Index) const { return It.at(SIZE_T(Index)); }
	auto begin() { return It.begin(); }
	auto end() { return It.end(); }
	auto begin() const { return It.begin(); }
	auto end() const { return It.end(); }

private:
	std::vector<Type> It;
};
template <class Type> class TArrayView
{
public:
	TArrayView(Type* InData, int32 InCount) : Data(InData), Count(InCount) {}
	Type& operator[](int32 Index) const { return Data[Index]; }
	int32 Num() const { return Count; }

private:
	Type* Data;
	int32 Count;
};
template <class Type> TArrayView<Type> MakeArrayView(Type* Data, int32 Count) { return {Data, Count}; }
template <class KeyType, class ValueType> class TMap
{
public:
	void Add(const KeyType& Key, const ValueType& Value) { It.insert_or_assign(Key, Value); }
	const ValueType* Find(const KeyType& Key) const
	{
		const auto At = It.find(Key);
		return At == It.end() ? nullptr : &At->second;
	}

private:
	std::unordered_map<KeyType, ValueType> It;
};
template <class Type> class TOptional
{
public:
	TOptional() = default;
	TOptional(const Type& Value) : It(Value) {}
	bool IsSet() const { return It.has_value(); }
	const Type& GetValue() const { return *It; }

private:
	std::optional<Type> It;
};
template <class Type> class TUniquePtr
{
public:
	TUniquePtr() = default;
	TUniquePtr(std::nullptr_t) {}
	explicit TUniquePtr(Type* Pointer) : It(Pointer) {}
	explicit operator bool() const { return bool(It); }
	Type* Get() const { return It.get(); }
	Type* operator->() const { return It.get(); }
	Type& operator*() const { return *It; }
	void Reset() { It.reset(); }

private:
	std::unique_ptr<Type> It;
};
template <class Type> class TSharedPtr
{
public:
	TSharedPtr() = default;
	explicit TSharedPtr(Type* Pointer) : It(Pointer) {}
	bool IsValid() const { return bool(It); }
	Type* operator->() const { return It.get(); }

private:
	std::shared_ptr<Type> It;
};
template <class Type> class TObjectPtr
{
public:
	TObjectPtr(Type* Pointer = nullptr) : It(Pointer) {}
	template <class OtherType, class = std::enable_if_t<std::is_convertible_v<OtherType*, Type*>>> TObjectPtr(const TObjectPtr<OtherType>& Other) : It(Other) {}
	operator Type*() const { return It; }
	Type* operator->() const { return It; }

private:
	Type* It;
};
template <class Type> class TWeakObjectPtr
{
public:
	TWeakObjectPtr(Type* Pointer = nullptr) : It(Pointer) {}
	Type* Get() const { return It; }

private:
	Type* It;
};

class FVTableHelper
{
};
class UObject
{
public:
	UObject() = default;
	UObject(FVTableHelper&) {}
	virtual ~UObject() = default;
};
template <class To, class From> To* Cast(From* Pointer) { return dynamic_cast<To*>(Pointer); }
struct TStatId
{
};
