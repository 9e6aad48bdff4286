using Pbmpm.Components;
using UnityEditor;
using UnityEngine;

namespace Pbmpm.Editing
{
    /// <summary>Objects for the scene, ready to play.</summary>
    internal static class SceneMenu
    {
        [MenuItem("GameObject/pbmpm/World", false, 10)]
        internal static void AddWorld(MenuCommand command)
        {
            var made = Make("pbmpm world", command);
            made.AddComponent<PbmpmWorld>();
            made.AddComponent<PbmpmPoints>();
            made.AddComponent<PbmpmHud>();
        }

        [MenuItem("GameObject/pbmpm/Fill", false, 11)]
        internal static void AddFill(MenuCommand command)
        {
            Make("Fill", command).AddComponent<PbmpmFill>();
        }

        [MenuItem("GameObject/pbmpm/Emitter", false, 11)]
        internal static void AddEmitter(MenuCommand command)
        {
            Make("Emitter", command).AddComponent<PbmpmEmitter>();
        }

        [MenuItem("GameObject/pbmpm/Drain", false, 11)]
        internal static void AddDrain(MenuCommand command)
        {
            Make("Drain", command).AddComponent<PbmpmDrain>();
        }

        [MenuItem("GameObject/pbmpm/Collider", false, 11)]
        internal static void AddCollider(MenuCommand command)
        {
            Make("Collider", command).AddComponent<PbmpmCollider>();
        }

        [MenuItem("GameObject/pbmpm/Force", false, 11)]
        internal static void AddForce(MenuCommand command)
        {
            Make("Force", command).AddComponent<PbmpmForce>();
        }

        static GameObject Make(string name, MenuCommand command)
        {
            var made = new GameObject(name);
            GameObjectUtility.SetParentAndAlign(made, command.context as GameObject);
            Undo.RegisterCreatedObjectUndo(made, "Create " + name);
            Selection.activeObject = made;
            return made;
        }
    }
}
