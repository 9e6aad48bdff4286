#pragma once
#include "CoreMinimal.h"
#include <future>
namespace UE::Tasks
{
using FTask = std::shared_future<void>;
template <class BodyType> FTask Launch(const TCHAR*, BodyType&& Body)
{
	return std::async(std::launch::async, std::forward<BodyType>(Body)).share();
}
template <class CollectionType> void Wait(const CollectionType& Tasks)
{
	for (const FTask& Task : Tasks)
	{
		Task.wait();
	}
}
} // namespace UE::Tasks
