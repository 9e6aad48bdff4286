using UnityEngine;

namespace Pbmpm.Components
{
    /// <summary>When a part enters, of those that wait.</summary>
    internal enum Turn
    {
        Obstacles,
        Flows,
        Matter,
    }

    /// <summary>Something in a world: it enters before the world's next step, and leaves when it is disabled.</summary>
    public abstract class PbmpmPart : MonoBehaviour
    {
        [Tooltip("Its world. None: the one above it, or else the first of the scene.")]
        public PbmpmWorld world;

        [Tooltip("Around its transform.")]
        public MatterShape shape = new MatterShape();

        PbmpmWorld owner;
        Placement known;
        bool changed;

        /// <summary>The world that it is in; null without one.</summary>
        public PbmpmWorld Owner => owner;

        /// <summary>Whether it is in its world now.</summary>
        public bool IsIn { get; private set; }

        internal abstract Turn Turn { get; }
        protected abstract Color GizmoColor { get; }

        /// <summary>Adds it to the library's world.</summary>
        protected abstract void Add(World core, Shape at);

        /// <summary>Takes it out again.</summary>
        protected abstract void Remove(World core);

        /// <summary>Its fields were changed: gives the library all of them.</summary>
        protected virtual void Alter(World core, Shape at)
        {
        }

        /// <summary>Its transform moved.</summary>
        protected virtual void Move(World core, Shape at)
        {
            Alter(core, at);
        }

        internal virtual void AfterStep(float seconds)
        {
        }

        /// <summary>Where it shall be at the end of the next step.</summary>
        internal virtual void Aim(float seconds, ref Placement place)
        {
        }

        /// <summary>Tells the world that a script changed fields of it.</summary>
        public void Change()
        {
            changed = true;
        }

        internal void Enter()
        {
            known = Placement.Of(transform);
            Add(owner.Core, shape.At(owner, known));
            IsIn = true;
            changed = false;
        }

        internal void Exit()
        {
            if (IsIn) Remove(owner.Core);
            Forget();
        }

        /// <summary>The library's world is no more, and what was in it.</summary>
        internal virtual void Forget()
        {
            IsIn = false;
        }

        internal void BeforeStep(float seconds)
        {
            var place = Placement.Of(transform);
            Aim(seconds, ref place);
            if (changed || place.Scale != known.Scale) Alter(owner.Core, shape.At(owner, place));
            else if (!place.StandsAs(known)) Move(owner.Core, shape.At(owner, place));
            known = place;
            changed = false;
        }

        protected virtual void OnEnable()
        {
            owner = Find();
            if (owner != null) owner.Join(this);
        }

        /// <summary>A world that was enabled after it.</summary>
        protected void Start()
        {
            if (owner != null) return;
            OnEnable();
            if (owner == null) Debug.LogError("pbmpm: '" + name + "' finds no world; put a PbmpmWorld above it, or anywhere in the scene", this);
        }

        protected virtual void OnDisable()
        {
            if (owner != null) owner.Leave(this);
            owner = null;
        }

        protected void OnValidate()
        {
            changed = true;
        }

        /// <summary>The world that it would join.</summary>
        internal PbmpmWorld Find()
        {
            if (world != null) return world;
            var above = GetComponentInParent<PbmpmWorld>();
            return above != null ? above : PbmpmWorld.First;
        }

        /// <summary>For the inspector, which tries a scene that does not play.</summary>
        internal void EnterForTrial(PbmpmWorld trial)
        {
            owner = trial;
            Enter();
        }

        internal void LeaveTrial()
        {
            Forget();
            owner = null;
        }

        protected void OnDrawGizmos()
        {
            shape.DrawGizmo(Placement.Of(transform), GizmoColor);
        }
    }
}
