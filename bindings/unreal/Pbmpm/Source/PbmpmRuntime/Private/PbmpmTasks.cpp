#include "PbmpmTasks.h"

#include "Tasks/Task.h"

namespace
{
	using FTasks = TArray<UE::Tasks::FTask>;

	void* Enqueue(pbmpm_task* Task, int32_t Count, void* Context, void*)
	{
		FTasks* Tasks = new FTasks();
		Tasks->Reserve(Count);
		for (int32 Index = 0; Index < Count; Index++)
		{
			Tasks->Add(UE::Tasks::Launch(TEXT("pbmpm"), [Task, Index, Context] { Task(Index, Context); }));
		}
		return Tasks;
	}

	void Finish(void* Handle, void*)
	{
		FTasks* Tasks = static_cast<FTasks*>(Handle);
		UE::Tasks::Wait(*Tasks);
		delete Tasks;
	}
} // namespace

pbmpm::task_hooks PbmpmTaskHooks()
{
	pbmpm::task_hooks Hooks;
	Hooks.enqueue = Enqueue;
	Hooks.finish = Finish;
	// Steps in the background run on the world's own thread: a worker of Unreal's would wait in it for others.
	Hooks.nests = 0;
	return Hooks;
}
